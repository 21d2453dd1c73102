#include <png.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

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

void write_png(const std::filesystem::path& path, const Image& image, float exposure) {
  const std::vector<std::uint8_t> pixels = encode_pixels(image, exposure);
  AtomicFile file(path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(file.temporary().c_str(), "wb"),
                                                            &std::fclose);
  if (!out) throw InputError(fmt::format("{}: cannot write: {}", path.string(), std::strerror(errno)));
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width());
  png.height = static_cast<png_uint_32>(image.height());
  png.format = PNG_FORMAT_RGB;
  const bool written = png_image_write_to_stdio(&png, out.get(), 0, pixels.data(), 0, nullptr) != 0;
  if (!written || std::fflush(out.get()) != 0) {
    throw InputError(
        fmt::format("{}: cannot write: {}", path.string(), written ? std::strerror(errno) : png.message));
  }
  file.commit();
}

}  // namespace facet
