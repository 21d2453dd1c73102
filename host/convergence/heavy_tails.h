#pragma once
// Pixels whose own variance is not to be trusted.
#include <array>
#include <cstdint>
#include <vector>

#include "image/film.h"

namespace facet {

/// Pixels that are made of very few of their samples: the others are (nearly) black beside those.
///
/// A pixel with such a light that its neighbours' samples have missed is far too bright, and the
/// neighbours are too dark with no variance that tells of it; so where such pixels carry much of
/// the variance, the true error is larger than the estimated one, by any factor.
struct HeavyTails {
  /// Pixels that rest on fewer samples than this are counted. Samples are as many equally bright
  /// ones among black ones as give the pixel's relative variance: mean^2 / variance of the mean,
  /// over all channels.
  static constexpr double few = 4;
  /// Pixels of fewer samples say nothing.
  static constexpr std::uint32_t least_samples = 16;

  std::uint64_t pixels = 0;
  std::uint32_t samples = 0;  ///< the most that one of them has
  double variance_share = 0;  ///< of the sum of all pixels' variances
  /// Up to ten pixels (x, y) of the whole image, those of the largest variances, largest first.
  std::vector<std::array<int, 2>> worst;

  /// Whether the estimated error is not to be trusted.
  [[nodiscard]] bool dominate() const { return variance_share > 0.5; }
};

/// Nothing is found in a film without squares.
[[nodiscard]] HeavyTails find_heavy_tails(const Film& film);

}  // namespace facet
