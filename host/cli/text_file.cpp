#include "cli/text_file.h"

#include "core/print.h"
#include "image/atomic_file.h"

namespace facet::cli {

void write_text(const std::string& target, const std::string& text) {
  if (target == "-") {
    put("{}", text);
    return;
  }
  AtomicFile file(target);
  file.write(text);
  file.commit();
}

}  // namespace facet::cli
