#pragma once
// Errors as values for people: one line that says where, what, and what would be right.
#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "core/text.h"

namespace facet {

/// Exit codes of the command line, which scripts depend on.
enum class ExitCode : int {
  done = 0,
  check_failed = 1,   ///< a comparison or test did not hold
  bad_input = 2,      ///< wrong usage, bad scene, unreadable or unwritable file
  device_failed = 3,  ///< no usable device, or it failed
  interrupted = 130,
};

/// A place in a file; line 0 means the file as a whole.
struct SourceLocation {
  std::string file;
  int line = 0;
};

/// "cbox.xml:31", or "cbox.xml" without a line.
inline std::string to_string(const SourceLocation& where) {
  return where.line > 0 ? fmt::format("{}:{}", where.file, where.line) : where.file;
}

/// Something that ends the command; what() is the whole message, one line without control characters.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(printable(message)), code_(code) {}
  [[nodiscard]] ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

/// Bad usage, a bad scene, or a file that cannot be read or written.
class InputError : public Error {
 public:
  explicit InputError(const std::string& message) : Error(ExitCode::bad_input, message) {}
  InputError(const SourceLocation& where, const std::string& message)
      : Error(ExitCode::bad_input, to_string(where) + ": " + message) {}
};

/// No usable device, or one that failed.
class DeviceError : public Error {
 public:
  explicit DeviceError(const std::string& message) : Error(ExitCode::device_failed, message) {}
};

}  // namespace facet
