#pragma once
// The film on the host: sums over samples, from which an image is developed.
#include <array>
#include <cstdint>
#include <vector>

#include "image/image.h"

namespace facet {

/// Sums over the samples of one pixel, for the channels R, G and B.
struct PixelSums {
  std::array<double, 3> values{};
  std::array<double, 3> squares{};  ///< 0 where the film keeps none
  std::uint32_t samples = 0;
  std::uint32_t nonzero = 0;  ///< samples whose value is not zero

  void add(const std::array<double, 3>& value);
  [[nodiscard]] bool operator==(const PixelSums&) const = default;
};

/// Pixels of an image or of a crop of it, row by row from the top.
struct Film {
  int width = 0;
  int height = 0;
  Image::Window window;
  bool has_squares = false;
  std::vector<PixelSums> pixels;
};

/// All sums zero. window: where the film lies in the whole image.
[[nodiscard]] Film make_film(int width, int height, const Image::Window& window, bool with_squares);

/// Channels R, G, B: the mean over samples. With variance also variance.R, variance.G, variance.B (of the
/// mean), samples and samples.nonzero; the film must have squares for it.
[[nodiscard]] Image develop(const Film& film, bool with_variance);

/// Variance of the mean of n samples from the sums of values and of squares; 0 for fewer than two samples.
[[nodiscard]] double variance_of_mean(double sum, double squares, double n);

}  // namespace facet
