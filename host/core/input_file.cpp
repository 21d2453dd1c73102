#include "core/input_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "core/text.h"

namespace facet {

namespace {

/// The path that exists and differs from the given one in case at most; empty if there is none.
std::filesystem::path find_in_other_case(const std::filesystem::path& path) {
  std::filesystem::path found;
  for (const std::filesystem::path& part : path) {
    std::error_code ignored;
    if (std::filesystem::exists(found / part, ignored)) {
      found /= part;
      continue;
    }
    bool has_match = false;
    const std::filesystem::path folder = found.empty() ? "." : found;
    for (std::filesystem::directory_iterator i(folder, ignored), end; i != end;
         i.increment(ignored)) {
      if (ignored || lower_case(i->path().filename().string()) != lower_case(part.string()))
        continue;
      found /= i->path().filename();
      has_match = true;
      break;
    }
    if (!has_match) return {};
  }
  return found;
}

/// "; there is \"Bunny.obj\"", or nothing.
std::string hint_for_missing(const std::filesystem::path& path) {
  std::string slashed = path.string();
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const std::filesystem::path found = find_in_other_case(slashed);
  if (!found.empty()) return fmt::format("; there is \"{}\"", found.string());
  return slashed == path.string() ? "" : "; folders are separated by \"/\", not by \"\\\"";
}

struct Signature {
  std::string_view start;
  std::string_view name;
};

// Longer ones first where one begins with another.
constexpr std::array<Signature, 28> signatures{{
    {"ply\n", "a PLY mesh"},
    {"ply\r", "a PLY mesh"},
    {"solid ", "an STL mesh"},
    {"glTF", "a glTF mesh"},
    {"Kaydara FBX", "an FBX scene"},
    {"BLENDER", "a Blender file"},
    {"OFF\n", "an OFF mesh"},
    {"#usda", "a USD scene"},
    {"PXR-USDC", "a USD scene"},
    {"\x89PNG\r\n", "a PNG image"},
    {"\xFF\xD8\xFF", "a JPEG image"},
    {"\x76\x2F\x31\x01", "an OpenEXR image"},
    {"#?RADIANCE", "a Radiance HDR image"},
    {"#?RGBE", "a Radiance HDR image"},
    {"GIF8", "a GIF image"},
    {std::string_view("II*\0", 4), "a TIFF image"},
    {std::string_view("MM\0*", 4), "a TIFF image"},
    {"BM", "a BMP image"},
    {"8BPS", "a Photoshop image"},
    {"DDS ", "a DDS image"},
    {"PF\n", "a PFM image"},
    {"P6\n", "a PPM image"},
    {"PK\x03\x04", "a ZIP archive"},
    {"\x1F\x8B", "a gzip archive"},
    {"BZh", "a bzip2 archive"},
    {"7z\xBC\xAF", "a 7-Zip archive"},
    {"\xFD"
     "7zXZ",
     "an XZ archive"},
    {"%PDF", "a PDF document"},
}};

bool looks_like_utf16(std::string_view start) {
  if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF")) return true;
  // Without a mark, every other byte of text is 0.
  return start.size() >= 4 && (start[0] == '\0') != (start[1] == '\0') &&
         (start[0] == '\0') == (start[2] == '\0') && (start[1] == '\0') == (start[3] == '\0');
}

}  // namespace

void check_input_file(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw InputError(fmt::format("{}: no such file{}", path.string(), hint_for_missing(path)));
  if (error) throw InputError(fmt::format("{}: cannot read: {}", path.string(), error.message()));
  if (std::filesystem::is_directory(status))
    throw InputError(fmt::format("{}: a folder, not a file", path.string()));
  if (!std::filesystem::is_regular_file(status))
    throw InputError(
        fmt::format("{}: not a file, but a pipe or a device, which cannot be read", path.string()));
}

std::string read_input_file(const std::filesystem::path& path) {
  check_input_file(path);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!in || error)
    throw InputError(fmt::format("{}: cannot read: {}", path.string(),
                                 errno != 0 ? std::strerror(errno) : error.message()));
  std::string text(size, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (static_cast<std::uintmax_t>(in.gcount()) != size)
    throw InputError(fmt::format("{}: cannot read all of it", path.string()));
  return text;
}

std::string read_start(const std::filesystem::path& path) {
  check_input_file(path);
  std::string start(1000, '\0');
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw InputError(fmt::format("{}: cannot read: {}", path.string(), std::strerror(errno)));
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  return start;
}

std::optional<std::string> recognise_foreign_file(std::string_view start, std::string_view wanted) {
  start = start.substr(0, 1000);
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos)
    return start.empty() ? "it is empty" : "it holds nothing but blanks";
  if (start.starts_with("version https://git-lfs"))
    return "it is a Git LFS pointer in place of the file; \"git lfs pull\" fetches the file itself";
  const auto signature =
      std::find_if(signatures.begin(), signatures.end(),
                   [&](const Signature& s) { return start.starts_with(s.start); });
  if (signature != signatures.end())
    return fmt::format("it is {}; convert it to {}", signature->name, wanted);
  if (looks_like_utf16(start)) return "it is text in UTF-16; save it as UTF-8";
  const std::string text = lower_case(std::string(start));
  if (start[first] == '<' &&
      (text.find("<html") != std::string::npos || text.find("<!doctype html") != std::string::npos))
    return "it is a web page in place of the file; download the file itself";
  return std::nullopt;
}

std::string describe_foreign_file(std::string_view start, std::string_view wanted) {
  if (const auto known = recognise_foreign_file(start, wanted)) return *known;
  const std::string_view line =
      start.substr(0, std::min<std::size_t>(start.find_first_of("\r\n"), 40));
  return fmt::format("it is not {}; it begins with \"{}\"", wanted, printable(line));
}

}  // namespace facet
