#pragma once
// Second estimates of some pixels, and what they say of the order of samples
// (docs/reference/sampling.md, "Estimated error").
#include <vector>

#include "image/film.h"

namespace facet {

/// Whether an image has pixels enough for probes to tell anything.
[[nodiscard]] bool has_probes(int width, int height);

/// The pixels that are probed, in ascending order.
[[nodiscard]] std::vector<std::uint32_t> choose_probes(int width, int height, std::uint32_t seed);

/// What the order of a pixel's samples leaves of the variance that their mean would have if they
/// were independent. Pixels of little variance gain most by order, so those of alike relative
/// variance are taken together.
class OrderGains {
 public:
  /// Pixels of alike relative variance.
  struct Stratum {
    double largest = 0;   ///< relative variance in it
    double ratio = 1;     ///< of the variance with order to that without
    double variance = 0;  ///< of the ratio's estimate
  };

  /// By the film's probes; without any there is one stratum, of ratio 1.
  OrderGains(const Film& film, double epsilon);

  /// Whether there were probes enough.
  [[nodiscard]] bool is_known() const { return known_; }
  [[nodiscard]] const std::vector<Stratum>& strata() const { return strata_; }
  /// Index of the stratum of a pixel's relative variance.
  [[nodiscard]] std::size_t stratum_of(double relative_variance) const;

 private:
  bool known_ = false;
  std::vector<Stratum> strata_;
};

}  // namespace facet
