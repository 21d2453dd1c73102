#pragma once
// Warnings, which --strict turns into errors.
#include <string>
#include <vector>

#include "core/error.h"

namespace facet {

/// Gathers the warnings of reading a scene.
class Diagnostics {
 public:
  /// strict: the first warning is an error.
  explicit Diagnostics(bool strict = false) : strict_(strict) {}

  void warn(const SourceLocation& where, const std::string& message) {
    if (strict_) throw InputError(where, message + " (--strict)");
    warnings_.push_back(to_string(where) + ": " + message);
  }

  [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

 private:
  bool strict_;
  std::vector<std::string> warnings_;
};

}  // namespace facet
