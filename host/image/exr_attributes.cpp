#include "image/exr_attributes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <utility>

#include "core/error.h"

namespace facet {

namespace {

// Of the file's layout (https://openexr.com/en/latest/OpenEXRFileLayout.html).
constexpr std::uint32_t multi_part_flag = 0x1000;  ///< of the version
constexpr std::size_t longest_name = 255;
constexpr std::uint64_t bytes_after_channel_name = 16;

/// Types whose values have one size, which OpenEXR reads whatever the header announces: the rest
/// would be taken for another attribute.
constexpr std::array<std::pair<std::string_view, std::uint32_t>, 27> fixed_sizes{{
    {"box2i", 16},
    {"box2f", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
    {"v4d", 32},
    {"v4f", 16},
    {"v4i", 16},
}};

/// Walks through a header as OpenEXR does.
class HeaderWalk {
 public:
  explicit HeaderWalk(const std::filesystem::path& path)
      : path_(path), in_(path, std::ios::binary) {
    std::error_code unknown;
    const std::uintmax_t size = std::filesystem::file_size(path, unknown);
    if (!unknown) file_bytes_ = size;
  }

  void check() {
    in_.seekg(exr_magic.size());
    const bool has_parts = (read_number() & multi_part_flag) != 0;
    // An empty name ends a header. Those of several parts follow each other, and one more ends
    // them.
    for (bool after_end = false; in_;) {
      const std::string name = read_name();
      if (name.empty() && (after_end || !has_parts)) return;
      after_end = name.empty();
      if (name.empty()) continue;
      const std::string type = read_name();
      const std::uint32_t size = read_number();
      if (!in_) return;
      check_value(name, type, size);
    }
  }

 private:
  /// Up to a zero byte, which is taken as well.
  std::string read_name() {
    std::string name;
    for (int c = in_.get(); c > 0 && name.size() <= longest_name; c = in_.get())
      name += static_cast<char>(c);
    return name;
  }

  /// Little-endian.
  std::uint32_t read_number() {
    std::uint32_t size = 0;
    for (unsigned shift = 0; shift < 32; shift += 8)
      size |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(in_.get())) << shift;
    return size;
  }

  [[nodiscard]] std::uint64_t position() { return static_cast<std::uint64_t>(in_.tellg()); }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(
        fmt::format("{}: not a readable EXR image: {}", path_.string(), printable(message)));
  }

  void check_value(const std::string& name, const std::string& type, std::uint32_t size) {
    const std::uint64_t begin = position();
    const std::uint64_t left = file_bytes_ - std::min<std::uint64_t>(file_bytes_, begin);
    if (size > left)
      fail(fmt::format("an attribute of its header announces {} bytes, {} are left", size, left));
    const auto fixed = std::find_if(fixed_sizes.begin(), fixed_sizes.end(),
                                    [&](const auto& known) { return known.first == type; });
    const bool fits = fixed != fixed_sizes.end() ? size == fixed->second
                      : type == "chlist"         ? read_channels(begin + size) == begin + size
                      : type == "stringvector"   ? read_strings(begin + size) == begin + size
                      : type == "preview"        ? preview_size() == size
                                                 : true;
    if (!fits || !in_)
      fail(
          fmt::format("its attribute \"{}\" of the type {} does not have the {} bytes that it "
                      "announces",
                      name, type, size));
    in_.seekg(static_cast<std::streamoff>(begin + size));
  }

  /// Where the list of channels ends.
  std::uint64_t read_channels(std::uint64_t end) {
    while (in_ && position() < end) {
      if (read_name().empty()) return position();
      in_.seekg(bytes_after_channel_name, std::ios::cur);
    }
    return 0;
  }

  /// Where the last string that begins before the end ends; 0 where one does not fit.
  std::uint64_t read_strings(std::uint64_t end) {
    while (in_ && position() < end) {
      const std::uint64_t length = read_number();
      if (!in_ || length > end - std::min(end, position())) return 0;
      in_.seekg(static_cast<std::streamoff>(length), std::ios::cur);
    }
    return in_ ? position() : 0;
  }

  /// Bytes of a preview image of the size that it announces.
  std::uint64_t preview_size() {
    const std::uint64_t width = read_number();
    const std::uint64_t height = read_number();
    constexpr std::uint64_t bytes_of_size = 8;
    constexpr std::uint64_t bytes_of_pixel = 4;
    constexpr std::uint64_t most = std::uint64_t{1} << 31U;
    return width < most && height < most && (height == 0 || width < most / height)
               ? bytes_of_size + bytes_of_pixel * width * height
               : 0;
  }

  const std::filesystem::path& path_;
  std::ifstream in_;
  std::uint64_t file_bytes_ = 0;
};

}  // namespace

void check_exr_attributes(const std::filesystem::path& path) { HeaderWalk(path).check(); }

}  // namespace facet
