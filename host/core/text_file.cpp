#include "core/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

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
  if (target == "-") return write_text(target, text);
  // What others append meanwhile stays.
  std::FILE* file = std::fopen(target.c_str(), "abe");
  const bool written =
      file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const bool closed = file != nullptr && std::fclose(file) == 0;
  if (!written || !closed)
    throw InputError(fmt::format("{}: cannot write: {}", target, std::strerror(errno)));
}

}  // namespace facet
