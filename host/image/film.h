#pragma once
// Films: sums over samples, from which images are developed.
#include <facet/film.h>

namespace facet {

/// All sums zero. window: where the film lies in the whole image.
[[nodiscard]] Film make_film(int width, int height, const ImageWindow& window, bool with_squares);

/// Adds the samples of another estimate of the pixel.
void add_sums(PixelSums& sums, const PixelSums& more);

/// Adds the samples of a film whose pixels are among those of the first, by their windows. The sum
/// keeps squares only if both have them.
void add_samples(Film& film, const Film& more);

/// Variance of the mean of n samples from the sums of values and of squares; 0 for fewer than two
/// samples.
[[nodiscard]] double variance_of_mean(double sum, double squares, double n);

/// The image with further channels, which are zero.
[[nodiscard]] Image with_channels(const Image& image, const std::vector<std::string>& more);

}  // namespace facet
