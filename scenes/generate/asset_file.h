#pragma once

#include <filesystem>
#include <functional>
#include <string>

/// How generated files come into being: complete or not at all, and only when they are missing or
/// of an older version.
namespace facet::generate {

/// Writes through a temporary file beside `file`, which `write` gets the name of, and then renames
/// it. Throws std::runtime_error or what `write` throws; the old file is then still there.
void replace_file(const std::filesystem::path& file,
                  const std::function<void(const std::filesystem::path&)>& write);
void replace_file(const std::filesystem::path& file, const std::string& content);

/// The first line of a file without its end of line, empty when there is no such file.
std::string first_line(const std::filesystem::path& file);

}  // namespace facet::generate
