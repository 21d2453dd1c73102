#pragma once
// Where within its filter a sample lies, and with what weight (docs/reference/sampling.md, "Camera
// and filter").
#include <vector>

#include "reference/real.h"
#include "scene/filter.h"

namespace facet::reference {

/// One axis of the image filter, sampled as |f|.
class FilterProfile {
 public:
  explicit FilterProfile(const Filter& filter);

  /// Offset from the pixel's centre, pixels.
  template <typename Real>
  [[nodiscard]] Real offset(Real u) const {
    const Real scaled = u * static_cast<Real>(offsets_.size() - 1);
    const auto i = static_cast<std::size_t>(scaled);
    const Real g = scaled - static_cast<Real>(i);
    const Real f0 = heights_[i];
    const Real f1 = heights_[i + 1];
    // Fraction of the interval below which the share g of a density linear from f0 to f1 lies.
    const Real below = f0 + std::sqrt(f0 * f0 + g * (f1 * f1 - f0 * f0));
    const Real fraction = below > 0 ? std::min(g * (f0 + f1) / below, Real(1)) : Real(0);
    return offsets_[i] + (Real(offsets_[i + 1]) - offsets_[i]) * fraction;
  }

  /// What a sample at this offset counts: the sign of f times the ratio of the integrals of |f| and
  /// f.
  template <typename Real>
  [[nodiscard]] Real weight(Real offset) const {
    return std::abs(offset) > Real(crossing_) ? -Real(ratio_) : Real(ratio_);
  }

 private:
  std::vector<float> offsets_;  ///< borders of intervals of equal mass
  std::vector<float> heights_;  ///< |f| there
  float crossing_ = 0;
  float ratio_ = 1;
};

}  // namespace facet::reference
