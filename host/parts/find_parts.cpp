#include "parts/find_parts.h"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "core/text.h"

namespace facet {

namespace {

std::vector<std::string> images_in(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (std::filesystem::directory_iterator i(folder, error), end; !error && i != end;
       i.increment(error)) {
    const std::filesystem::path& path = i->path();
    if (lower_case(path.extension().string()) == ".exr" &&
        !path.filename().string().starts_with('.'))
      files.push_back(path.string());
  }
  if (error) throw InputError(fmt::format("{}: cannot be listed: {}", folder, error.message()));
  std::ranges::sort(files);
  return files;
}

std::vector<std::string> files_of(const std::string& pattern) {
  ::glob_t found{};
  std::vector<std::string> files;
  if (::glob(pattern.c_str(), GLOB_MARK, nullptr, &found) == 0) {
    for (std::size_t i = 0; i < found.gl_pathc; ++i) files.emplace_back(found.gl_pathv[i]);
  }
  ::globfree(&found);
  // Those are folders.
  std::erase_if(files, [](const std::string& file) { return file.ends_with('/'); });
  return files;
}

}  // namespace

std::vector<std::string> find_parts(const std::vector<std::string>& arguments,
                                    const std::vector<std::string>& outputs) {
  const auto is_output = [&](const std::string& file) {
    return std::ranges::any_of(outputs, [&](const std::string& output) {
      std::error_code ignored;
      return std::filesystem::equivalent(file, output, ignored);
    });
  };
  std::vector<std::string> files;
  for (const std::string& argument : arguments) {
    std::error_code ignored;
    const bool is_folder = std::filesystem::is_directory(argument, ignored);
    const bool is_pattern = !is_folder && argument.find_first_of("*?[") != std::string::npos &&
                            !std::filesystem::exists(argument, ignored);
    if (!is_folder && !is_pattern) {
      files.push_back(argument);
      continue;
    }
    std::vector<std::string> found = is_folder ? images_in(argument) : files_of(argument);
    std::erase_if(found, is_output);
    if (found.empty())
      throw InputError(
          fmt::format("{}: {}", argument,
                      is_folder ? "no .exr lies in this folder" : "no file has a name like this"));
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

}  // namespace facet
