#include "core/error.h"

#include <utility>

namespace facet {

std::string to_string(const SourceLocation& where) {
  return where.line > 0 ? fmt::format("{}:{}", where.file, where.line) : where.file;
}

Error::Error(ErrorKind kind, SourceLocation where, const std::string& message)
    : std::runtime_error(
          printable(where.file.empty() ? message : to_string(where) + ": " + message)),
      kind_(kind),
      where_(std::move(where)) {}

}  // namespace facet
