#include <png.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "core/error.h"
#include "image/atomic_file.h"
#include "image/files.h"

namespace facet {

namespace {

/// IEC 61966-2-1, 8 bits. NaN becomes black.
std::uint8_t encode_srgb(float linear) {
  const double x = linear > 0 ? std::min(static_cast<double>(linear), 1.0) : 0.0;
  const double v = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(v * 255));
}

std::array<float, 256> decode_table() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double v = static_cast<double>(i) / 255;
    table[i] = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
  }
  return table;
}

/// libpng's image of a file, released at the end.
struct PngFile : png_image {
  PngFile() : png_image{} { version = PNG_IMAGE_VERSION; }
  ~PngFile() { png_image_free(this); }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;
};

std::vector<std::uint8_t> encode_pixels(const Image& image, float exposure) {
  const float factor = std::exp2(exposure);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  const int channels[3] = {image.find_channel("R"), image.find_channel("G"), image.find_channel("B")};
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (const int c : channels) pixels.push_back(encode_srgb(image.at(x, y, c) * factor));
    }
  }
  return pixels;
}

}  // namespace

const std::array<float, 256>& srgb_values() {
  static const std::array<float, 256> values = decode_table();
  return values;
}

ByteImage read_png_bytes(const std::filesystem::path& path) {
  check_readable(path);
  PngFile png;
  const auto fail = [&] {
    throw InputError(fmt::format("{}: not a readable PNG image: {}", path.string(), png.message));
  };
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) fail();
  check_file_image_size(path, png.width, png.height);
  if ((png.format & PNG_FORMAT_FLAG_LINEAR) != 0)
    throw InputError(fmt::format("{}: has 16 bits a channel; PNGs of 8 are read", path.string()));
  png.format = PNG_FORMAT_RGB;
  ByteImage image{static_cast<int>(png.width), static_cast<int>(png.height), {}};
  image.pixels.resize(3 * static_cast<std::size_t>(png.width) * png.height);
  const png_color black{};
  if (png_image_finish_read(&png, &black, image.pixels.data(), 0, nullptr) == 0) fail();
  return image;
}

Image read_png(const std::filesystem::path& path) {
  const ByteImage bytes = read_png_bytes(path);
  Image image(bytes.width, bytes.height, {"R", "G", "B"});
  for (std::size_t i = 0; i < bytes.pixels.size(); ++i)
    image.plane(static_cast<int>(i % 3))[i / 3] = srgb_values().at(bytes.pixels[i]);
  return image;
}

void write_png(const std::filesystem::path& path, const Image& image, float exposure) {
  const std::vector<std::uint8_t> pixels = encode_pixels(image, exposure);
  AtomicFile file(path);
  std::FILE* out = ::fdopen(::dup(file.descriptor()), "wb");
  if (out == nullptr)
    throw InputError(fmt::format("{}: cannot write: {}", path.string(), std::strerror(errno)));
  PngFile png;
  png.width = static_cast<png_uint_32>(image.width());
  png.height = static_cast<png_uint_32>(image.height());
  png.format = PNG_FORMAT_RGB;
  errno = 0;
  const bool written = png_image_write_to_stdio(&png, out, 0, pixels.data(), 0, nullptr) != 0;
  int error = errno;
  const bool closed = std::fclose(out) == 0;
  if (written && !closed) error = errno;
  if (!written || !closed)
    throw InputError(
        fmt::format("{}: cannot write: {}", path.string(), error != 0 ? std::strerror(error) : png.message));
  file.commit();
}

}  // namespace facet
