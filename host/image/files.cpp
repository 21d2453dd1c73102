#include "image/files.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/input_file.h"
#include "core/memory.h"
#include "image/exr_attributes.h"

namespace facet {

namespace {

constexpr std::string_view wanted = "an OpenEXR, PNG, JPEG or HDR image";

/// Codes as linear light.
Image decode(const CodedImage& coded) {
  Image image(coded.width, coded.height, {"R", "G", "B"});
  for (std::size_t i = 0; i < coded.codes.size(); ++i) {
    const std::uint16_t code = coded.codes[i];
    image.plane(static_cast<int>(i % 3))[i / 3] =
        coded.largest == 255
            ? srgb_values()[code]
            : static_cast<float>(decode_srgb(static_cast<double>(code) / coded.largest));
  }
  return image;
}

}  // namespace

ImageFormat output_format(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".exr") return ImageFormat::exr;
  if (extension == ".png") return ImageFormat::png;
  throw InputError(fmt::format("{}: the format follows the extension, which must be .exr or .png",
                               path.string()));
}

ImageFormat image_format(const std::filesystem::path& path) {
  const std::string start = read_start(path);
  if (start.starts_with(exr_magic)) return ImageFormat::exr;
  if (start.starts_with("\x89PNG\r\n\x1A\n")) return ImageFormat::png;
  if (start.starts_with("\xFF\xD8\xFF")) return ImageFormat::jpeg;
  if (start.starts_with("#?RADIANCE") || start.starts_with("#?RGBE")) return ImageFormat::hdr;
  throw InputError(fmt::format("{}: {}", path.string(), describe_foreign_file(start, wanted)));
}

Image read_image(const std::filesystem::path& path) {
  const Activity activity("reading the image " + path.string());
  switch (image_format(path)) {
    case ImageFormat::exr:
      return read_exr(path);
    case ImageFormat::hdr:
      return read_hdr(path);
    case ImageFormat::png:
      return decode(read_png(path));
    case ImageFormat::jpeg:
      return decode(read_jpeg(path));
  }
  throw std::logic_error("no such format");
}

double decode_srgb(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

const std::array<float, 256>& srgb_values() {
  static const std::array<float, 256> values = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = static_cast<float>(decode_srgb(static_cast<double>(i) / 255));
    return table;
  }();
  return values;
}

void check_file_image_size(const std::filesystem::path& path, long long width, long long height,
                           std::size_t channels, double values_per_byte) {
  const auto check_bytes = [&] {
    std::error_code unknown;
    const auto bytes = static_cast<double>(std::filesystem::file_size(path, unknown));
    const double values = static_cast<double>(width * height) * static_cast<double>(channels);
    if (unknown || values <= bytes * values_per_byte) return;
    throw InputError(
        fmt::format("{}: announces {}x{} pixels of {} channels, which its {} bytes "
                    "cannot hold",
                    path.string(), width, height, channels, bytes));
  };
  if (width >= 1 && height >= 1 && width <= largest_file_side && height <= largest_file_side &&
      width * height <= largest_file_area &&
      width * height <=
          largest_file_values / std::max<long long>(1, static_cast<long long>(channels)))
    return check_bytes();
  throw InputError(
      fmt::format("{}: announces {}x{} pixels of {} channels; sides are read up to {}, in all {} "
                  "pixels and {} values",
                  path.string(), width, height, channels, largest_file_side, largest_file_area,
                  largest_file_values));
}

void check_writable(const std::filesystem::path& path) {
  const AtomicFile file(path);
  // Opening a pipe would wait for its reader.
  if (file.in_place() && ::access(path.c_str(), W_OK) != 0)
    throw InputError(fmt::format("{}: cannot write: no permission", path.string()));
}

}  // namespace facet
