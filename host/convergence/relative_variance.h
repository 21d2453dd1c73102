#pragma once
// What a pixel's samples say of its relative error.
#include "image/film.h"

namespace facet {

/// One value a channel.
using Color3 = std::array<double, 3>;

/// Of the mean of a pixel's samples, by their own variance.
[[nodiscard]] Color3 variance_by_samples(const PixelSums& pixel);

/// A variance relative to a mean: over mean^2 + epsilon; the mean over channels.
[[nodiscard]] double relative_variance(const Color3& variance, const Color3& mean, double epsilon);

/// What relative squared errors have below them beside the square of the mean: (0.01 mean
/// luminance)^2 of the film's image, or next to nothing where that is black.
[[nodiscard]] double relmse_epsilon(const Film& film);

}  // namespace facet
