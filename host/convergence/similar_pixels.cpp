#include "convergence/similar_pixels.h"

#include <algorithm>
#include <cmath>

#include "convergence/plane.h"

namespace facet {

namespace {

constexpr int window = 10;

/// Probability that chi-squared is larger, of so many degrees of freedom or one more: an even
/// number (Abramowitz and Stegun 26.4.5).
double survival(double chi_squared, int degrees) {
  const double half = chi_squared / 2;
  double term = 1;
  double sum = 0;
  for (int k = 0; 2 * k < degrees; ++k) {
    sum += term;
    term *= half / (k + 1);
  }
  return std::exp(-half) * sum;
}

}  // namespace

SimilarPixels::SimilarPixels(const Film& film, double epsilon)
    : film_(film),
      epsilon_(epsilon),
      means_(film.pixels.size()),
      own_variances_(film.pixels.size()),
      variances_(film.pixels.size()) {
  for (std::size_t i = 0; i < means_.size(); ++i) {
    means_[i] = film.pixels[i].mean();
    own_variances_[i] = variance_by_samples(film.pixels[i]);
  }
  // A pixel that has missed a flash has no variance that tells of it; its neighbours may.
  for (std::size_t c = 0; c < 3; ++c) {
    Plane variances(film);
    for (std::size_t i = 0; i < means_.size(); ++i) variances.values[i] = own_variances_[i][c];
    variances = variances.blurred(1);
    for (std::size_t i = 0; i < means_.size(); ++i) variances_[i][c] = variances.values[i];
  }
}

double SimilarPixels::likeness(int x, int y, int other_x, int other_y) const {
  double distance = 0;
  int compared = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 0) continue;
      const bool there = film_.holds(x + dx, y + dy);
      if (there != film_.holds(other_x + dx, other_y + dy)) return 0;
      if (!there) continue;
      distance += difference(film_.index(x + dx, y + dy), film_.index(other_x + dx, other_y + dy));
      ++compared;
    }
  }
  return survival(distance, compared);
}

double SimilarPixels::difference(std::size_t a, std::size_t b) const {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double difference = means_[a][c] - means_[b][c];
    // A tenth of the value is no difference that would matter here.
    const double tolerance =
        0.01 * std::min(means_[a][c] * means_[a][c], means_[b][c] * means_[b][c]);
    sum += difference * difference / (variances_[a][c] + variances_[b][c] + tolerance + epsilon_);
  }
  return sum / 3;
}

SimilarPixels::Mean SimilarPixels::mean(int x, int y) const {
  Mean mean;
  Color3 variance{};
  double weights = 0;
  for (int oy = std::max(y - window, 0); oy <= std::min(y + window, film_.height - 1); ++oy) {
    for (int ox = std::max(x - window, 0); ox <= std::min(x + window, film_.width - 1); ++ox) {
      const double weight = ox == x && oy == y ? 1 : likeness(x, y, ox, oy);
      const std::size_t i = film_.index(ox, oy);
      weights += weight;
      for (std::size_t c = 0; c < 3; ++c) {
        mean.value[c] += weight * means_[i][c];
        variance[c] += weight * weight * own_variances_[i][c];
      }
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    mean.flashes[c] = mean.value[c] * mean.value[c] / variance[c];
    mean.value[c] /= weights;
  }
  return mean;
}

}  // namespace facet
