#include "report/packed_image.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "compare/metrics.h"
#include "report/page.h"

namespace facet::report {

namespace {

std::size_t pixel_count(const Image& image) {
  return static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
}

}  // namespace

std::string packed_halves(const Image& image, float scale) {
  const auto planes = rgb_planes(image);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(6 * pixel_count(image));
  for (std::size_t i = 0; i < pixel_count(image); ++i) {
    for (const float* plane : planes) {
      const float v = plane[i] / scale;
      // The largest half stands for what exceeds it; infinity stays.
      const std::uint16_t half =
          glm::packHalf1x16(std::isfinite(v) ? std::clamp(v, -65504.F, 65504.F) : v);
      bytes.push_back(static_cast<std::uint8_t>(half & 0xFFU));
      bytes.push_back(static_cast<std::uint8_t>(half >> 8U));
    }
  }
  return base64(bytes);
}

float half_scale(std::span<const Image* const> images) {
  float largest = 0;
  for (const Image* image : images) {
    for (const float* plane : rgb_planes(*image)) {
      for (std::size_t i = 0; i < pixel_count(*image); ++i) {
        if (std::isfinite(plane[i])) largest = std::max(largest, std::abs(plane[i]));
      }
    }
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  // Halves keep all their digits from 2^-14 to 2^15.
  return exponent > 15 || (largest > 0 && exponent < 0)
             ? std::ldexp(1.F, std::clamp(exponent - 15, -126, 127))
             : 1.F;
}

}  // namespace facet::report
