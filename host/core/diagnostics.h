#pragma once
// What reading a scene keeps account of: warnings, which --strict turns into errors, and the files
// that are read.
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"

namespace facet {

/// What is let pass.
struct ReadingRules {
  bool strict = false;  ///< whether a warning is an error
  /// Where not empty: the folder below which all files must lie, after links.
  std::filesystem::path assets_below;
};

/// Gathers the warnings of reading a scene, and the files that it is made of.
class Diagnostics {
 public:
  explicit Diagnostics(bool strict = false) { rules_.strict = strict; }
  /// Throws InputError where assets are to be below what is no folder.
  explicit Diagnostics(ReadingRules rules);

  /// Throws InputError where warnings are errors.
  void warn(const SourceLocation& where, const std::string& message);
  [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

  /// Notes a file that is going to be read: what is written afterwards must not take its place.
  /// where: what names it. Throws InputError where it must not be read.
  void add_input(const SourceLocation& where, const std::filesystem::path& file);
  [[nodiscard]] const std::vector<std::filesystem::path>& inputs() const noexcept {
    return inputs_;
  }

 private:
  ReadingRules rules_;
  std::vector<std::string> warnings_;
  std::vector<std::filesystem::path> inputs_;
};

}  // namespace facet
