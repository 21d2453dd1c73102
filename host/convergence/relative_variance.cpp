#include "convergence/relative_variance.h"

#include <algorithm>

#include "core/maths.h"

namespace facet {

double relmse_epsilon(const Film& film) {
  double luminance_sum = 0;
  for (const PixelSums& p : film.pixels) {
    const auto& v = p.values;
    if (p.samples > 0) luminance_sum += luminance(dvec3(v[0], v[1], v[2])) / p.samples;
  }
  const double hundredth = 0.01 * luminance_sum / static_cast<double>(film.pixels.size());
  return std::max(hundredth * hundredth, 1e-300);
}

Color3 variance_by_samples(const PixelSums& pixel) {
  Color3 variance{};
  for (std::size_t c = 0; c < 3; ++c)
    variance[c] = variance_of_mean(pixel.values[c], pixel.squares[c], pixel.samples);
  return variance;
}

double relative_variance(const Color3& variance, const Color3& mean, double epsilon) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += variance[c] / (mean[c] * mean[c] + epsilon);
  return sum / 3;
}

}  // namespace facet
