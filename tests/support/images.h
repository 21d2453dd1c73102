#pragma once
// Images that tests write.
#include <facet/film.h>

#include <cstdint>
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

/// The largest value of the first channel, 0 at least.
inline float largest(const Image& image) {
  float most = 0;
  for (int i = 0; i < image.width() * image.height(); ++i)
    most = std::max(most, image.at(i % image.width(), i / image.width(), 0));
  return most;
}

}  // namespace facet::test
