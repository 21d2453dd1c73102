#include "image/exr_attributes.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string>

#include "core/error.h"

namespace facet {

namespace {

// Of the file's layout (https://openexr.com/en/latest/OpenEXRFileLayout.html).
constexpr std::uint32_t multi_part_flag = 0x1000;  ///< of the version
constexpr std::size_t longest_name = 255;

/// Up to a zero byte, which is taken as well.
std::string read_name(std::ifstream& in) {
  std::string name;
  for (int c = in.get(); c > 0 && name.size() <= longest_name; c = in.get())
    name += static_cast<char>(c);
  return name;
}

/// Little-endian.
std::uint32_t read_number(std::ifstream& in) {
  std::uint32_t size = 0;
  for (unsigned shift = 0; shift < 32; shift += 8)
    size |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(in.get())) << shift;
  return size;
}

}  // namespace

void check_exr_attributes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::error_code unknown;
  const std::uintmax_t all = std::filesystem::file_size(path, unknown);
  if (!in || unknown) return;
  in.seekg(exr_magic.size());
  const bool has_parts = (read_number(in) & multi_part_flag) != 0;
  // An empty name ends a header. Those of several parts follow each other, and one more ends them.
  for (bool after_end = false; in;) {
    const std::string name = read_name(in);
    if (name.empty() && (after_end || !has_parts)) return;
    after_end = name.empty();
    if (name.empty()) continue;
    (void)read_name(in);  // of the type
    const std::uint32_t size = read_number(in);
    if (!in) return;
    const auto here = static_cast<std::uintmax_t>(in.tellg());
    if (size > all - std::min(all, here))
      throw InputError(fmt::format(
          "{}: not a readable EXR image: an attribute of its header announces {} bytes, "
          "{} are left",
          path.string(), size, all - std::min(all, here)));
    in.seekg(size, std::ios::cur);
  }
}

}  // namespace facet
