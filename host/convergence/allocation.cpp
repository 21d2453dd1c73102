#include "convergence/allocation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "convergence/plane.h"
#include "convergence/relative_variance.h"
#include "image/film.h"

namespace facet {

namespace {

/// The mean of each pixel's own and its neighbours'.
Plane with_neighbours(const Plane& plane) {
  Plane result = plane.blurred(1);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] = (result.values[i] + plane.values[i]) / 2;
  return result;
}

/// What the pilot says of its pixels: estimates of their terms of relMSE for a mean of as many
/// samples as the pilot has. A few samples tell little of a pixel, least of all what they have
/// missed, hence its neighbours' help: with their variances, not with those relative to their
/// means, since next to what is bright and seen lies what is dark and has just not seen it.
class Pilot {
 public:
  Pilot(const Film& first_half, const Film& all)
      : errors(all), of_first(all), of_second(all), first_half_(first_half), all_(all) {
    const double epsilon = relmse_epsilon(all);
    Plane by_halves(all);
    Plane by_samples(all);
    for (std::size_t c = 0; c < 3; ++c) {
      Plane weights(all);
      for (std::size_t i = 0; i < weights.values.size(); ++i)
        weights.values[i] = all.pixels[i].mean()[c];
      weights = weights.blurred(1);
      for (double& w : weights.values) w = 1 / (w * w + epsilon);
      add_channel(c, weights, by_halves, by_samples);
    }
    heed_order(by_halves.blurred(3), by_samples.blurred(3));
  }

  Plane errors;    ///< by the variance of all samples
  Plane of_first;  ///< by that of each half of them
  Plane of_second;

 private:
  void add_channel(std::size_t c, const Plane& weights, Plane& by_halves, Plane& by_samples) {
    Plane whole(all_);
    Plane first(all_);
    Plane second(all_);
    for (std::size_t i = 0; i < weights.values.size(); ++i) {
      const PixelSums& half = first_half_.pixels[i];
      const PixelSums& all = all_.pixels[i];
      const double n = half.samples;
      const double m = all.samples - n;
      const double rest = all.values[c] - half.values[c];
      whole.values[i] = variance_of_mean(all.values[c], all.squares[c], all.samples);
      first.values[i] = variance_of_mean(half.values[c], half.squares[c], n) / 2;
      second.values[i] = variance_of_mean(rest, all.squares[c] - half.squares[c], m) / 2;
      if (!(n > 0 && m > 0)) continue;
      const double difference = (half.values[c] / n - rest / m) / 2;
      by_halves.values[i] += weights.values[i] * difference * difference;
      by_samples.values[i] += weights.values[i] * whole.values[i];
    }
    for (const auto& [from, to] : {std::pair(&whole, &errors), std::pair(&first, &of_first),
                                   std::pair(&second, &of_second)}) {
      const Plane helped = with_neighbours(*from);
      for (std::size_t i = 0; i < weights.values.size(); ++i)
        to->values[i] += weights.values[i] * helped.values[i];
    }
  }

  /// Points that are spread evenly err less than the variance of single samples says: by how much,
  /// the difference between the halves tells, over many pixels.
  void heed_order(const Plane& by_halves, const Plane& by_samples) {
    constexpr double least_share = 1.0 / 64;
    for (std::size_t i = 0; i < errors.values.size(); ++i) {
      if (!(by_samples.values[i] > 0)) continue;
      const double share = std::clamp(by_halves.values[i] / by_samples.values[i], least_share, 1.0);
      errors.values[i] *= share;
      of_first.values[i] *= share;
      of_second.values[i] *= share;
    }
  }

  const Film& first_half_;
  const Film& all_;
};

/// Logarithms of a plane over its mean, nothing counting as less than a thousandth.
std::vector<double> logarithms(const Plane& plane) {
  const double mean = plane.mean();
  std::vector<double> result;
  result.reserve(plane.values.size());
  for (const double v : plane.values) result.push_back(std::log(v / mean + 1e-3));
  return result;
}

/// How far the pilot's differences between pixels are theirs, not chance: the correlation of its
/// halves, extended to the whole (C. Spearman, W. Brown 1910). 0: not at all, 1: all.
double reliability(const Pilot& pilot) {
  const std::vector<double> a = logarithms(pilot.of_first);
  const std::vector<double> b = logarithms(pilot.of_second);
  const auto n = static_cast<double>(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double aa = 0;
  double bb = 0;
  double ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  if (!(aa > 0 && bb > 0)) return 0;
  const double r = std::clamp(ab / std::sqrt(aa * bb), 0.0, 1.0);
  return 2 * r / (1 + r);
}

/// How many of 2^k, nearest in its logarithm and within bounds.
unsigned exponent_of(double logarithm, int least, int most) {
  return static_cast<unsigned>(
      std::clamp(static_cast<int>(std::floor(logarithm + 0.5)), least, most));
}

}  // namespace

std::uint32_t pilot_samples(std::uint32_t mean) {
  return std::clamp(std::bit_floor(mean / 8), 4U, 32U);
}

std::uint32_t smallest_allocation(std::uint32_t mean) {
  return std::max(std::bit_floor(mean) / 8, 2U);
}

Allocation::Allocation(const Film& first_half, const Film& pilot) {
  const Pilot known(first_half, pilot);
  // To the root of the error where that is known, less so where it is not.
  const double power = reliability(known) / 2;
  wishes_.reserve(known.errors.values.size());
  for (const double e : known.errors.values) {
    const double wish = std::pow(e, power);
    wishes_.push_back(wish > 0 ? std::max(std::log2(wish), -1000.0) : -1000.0);
  }
}

std::vector<std::uint32_t> Allocation::counts(std::uint32_t mean, std::uint32_t budget) const {
  const int least = std::countr_zero(smallest_allocation(mean));
  const int most = std::countr_zero(std::bit_floor(std::min(mean, 1U << 24U)) * 64);
  const auto total = [&](double factor) {
    double sum = 0;
    for (const double w : wishes_)
      sum += static_cast<double>(1U << exponent_of(w + factor, least, most));
    return sum;
  };
  // The largest factor, which all have in common, within the budget.
  const double available = static_cast<double>(budget) * static_cast<double>(wishes_.size());
  double low = -1100;
  double high = 1100;
  for (int k = 0; k < 50; ++k) {
    const double middle = (low + high) / 2;
    (total(middle) <= available ? low : high) = middle;
  }
  std::vector<std::uint32_t> result;
  result.reserve(wishes_.size());
  for (const double w : wishes_) result.push_back(1U << exponent_of(w + low, least, most));
  return result;
}

}  // namespace facet
