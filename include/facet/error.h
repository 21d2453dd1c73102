#pragma once
// Errors of facet: one exception type, with its kind and, where a file is to blame, its place.
#include <stdexcept>
#include <string>

namespace facet {

/// A place in a file; line 0 stands for the file as a whole.
struct SourceLocation {
  std::string file;
  int line = 0;
};

/// "cbox.xml:31", or "cbox.xml" without a line.
[[nodiscard]] std::string to_string(const SourceLocation& where);

enum class ErrorKind {
  input,   ///< a bad scene or request, or a file that cannot be read or written
  device,  ///< no usable device, or a device that failed
};

/// What every function of facet throws. what() is the whole message: one line without control
/// characters that names the place, what was found and what would be right.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : Error(kind, {}, message) {}
  /// The message is put behind the place.
  Error(ErrorKind kind, SourceLocation where, const std::string& message);

  [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }
  /// An empty file name where no place is known.
  [[nodiscard]] const SourceLocation& where() const noexcept { return where_; }

 private:
  ErrorKind kind_;
  SourceLocation where_;
};

}  // namespace facet
