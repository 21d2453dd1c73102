#pragma once
// Warnings, which --strict turns into errors, and the files that were read.
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"

namespace facet {

/// Gathers the warnings of reading a scene, and the files that it is made of.
class Diagnostics {
 public:
  /// strict: the first warning is an error.
  explicit Diagnostics(bool strict = false) : strict_(strict) {}

  void warn(const SourceLocation& where, const std::string& message) {
    if (strict_) throw InputError(where, message + " (--strict)");
    warnings_.push_back(printable(to_string(where) + ": " + message));
  }

  [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

  /// Notes files that are read: what is written afterwards must not take their place.
  void add_inputs(const std::vector<std::filesystem::path>& files) {
    inputs_.insert(inputs_.end(), files.begin(), files.end());
  }
  [[nodiscard]] const std::vector<std::filesystem::path>& inputs() const noexcept {
    return inputs_;
  }

 private:
  bool strict_;
  std::vector<std::string> warnings_;
  std::vector<std::filesystem::path> inputs_;
};

}  // namespace facet
