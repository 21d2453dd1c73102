#pragma once
// Images that tests write.
#include <facet/film.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace facet::test {

/// Values without a pattern that compression could shrink to nothing.
[[nodiscard]] inline Image make_image(int width, int height,
                                      const std::vector<std::string>& channels) {
  Image image(width, height, channels);
  std::uint32_t state = 1;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    for (int i = 0; i < width * height; ++i) {
      state = 1664525U * state + 1013904223U;
      image.at(i % width, i / width, static_cast<int>(c)) = static_cast<float>(state) * 1e-9F;
    }
  }
  return image;
}

/// Steps from one float to the other, through all floats between.
inline std::int64_t ulps_between(float a, float b) {
  const auto rank = [](float x) {
    const auto bits = std::bit_cast<std::int32_t>(x);
    return bits < 0 ? -std::int64_t{bits & 0x7fffffff} : std::int64_t{bits};
  };
  return std::abs(rank(a) - rank(b));
}

/// The largest value of the first channel, 0 at least.
inline float largest(const Image& image) {
  float most = 0;
  for (int i = 0; i < image.width() * image.height(); ++i)
    most = std::max(most, image.at(i % image.width(), i / image.width(), 0));
  return most;
}

}  // namespace facet::test
