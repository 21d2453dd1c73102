#include "core/diagnostics.h"

#include <algorithm>
#include <utility>

#include "core/text.h"

namespace facet {

Diagnostics::Diagnostics(ReadingRules rules) : rules_(std::move(rules)) {
  if (rules_.assets_below.empty()) return;
  std::error_code error;
  const auto folder = std::filesystem::canonical(rules_.assets_below, error);
  if (error || !std::filesystem::is_directory(folder, error))
    throw InputError(
        fmt::format("{}: no folder for assets to be below of", rules_.assets_below.string()));
  rules_.assets_below = folder;
}

void Diagnostics::warn(const SourceLocation& where, const std::string& message) {
  if (rules_.strict) throw InputError(where, message + " (--strict)");
  warnings_.push_back(printable(to_string(where) + ": " + message));
}

void Diagnostics::add_input(const SourceLocation& where, const std::filesystem::path& file) {
  inputs_.push_back(file);
  const std::filesystem::path& folder = rules_.assets_below;
  if (folder.empty()) return;
  // Links of links that end nowhere have no canonical path.
  std::error_code error;
  const auto real =
      std::filesystem::weakly_canonical(std::filesystem::absolute(file, error), error);
  const auto [part, rest] = std::mismatch(folder.begin(), folder.end(), real.begin(), real.end());
  if (!error && part == folder.end() && rest != real.end()) return;
  throw InputError(
      where, fmt::format("{}: is not read, as it is not below {}", file.string(), folder.string()));
}

}  // namespace facet
