#include "cli/text_file.h"

#include <fmt/format.h>

#include <fstream>

#include "core/error.h"
#include "image/atomic_file.h"

namespace facet::cli {

void write_text(const std::string& target, const std::string& text) {
  if (target == "-") {
    fmt::print("{}", text);
    return;
  }
  AtomicFile file(target);
  std::ofstream out(file.temporary());
  out << text;
  out.close();
  if (!out) throw InputError(fmt::format("{}: cannot write", target));
  file.commit();
}

}  // namespace facet::cli
