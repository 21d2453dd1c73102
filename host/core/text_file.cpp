#include "core/text_file.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/atomic_file.h"
#include "core/error.h"

namespace facet {

void write_text(const std::string& target, const std::string& text) {
  if (target == "-") {
    (void)std::fwrite(text.data(), 1, text.size(), stdout);
    return;
  }
  AtomicFile file(target);
  file.write(text);
  file.commit();
}

void append_text(const std::string& target, const std::string& text) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(target, unknown)) return write_text(target, text);
  std::ifstream file(target, std::ios::binary);
  std::ostringstream before;
  before << file.rdbuf();
  // An empty file sets the stream's failure, since nothing was copied.
  if (!file.is_open() || file.bad()) throw InputError(target + ": cannot be read");
  write_text(target, before.str() + text);
}

}  // namespace facet
