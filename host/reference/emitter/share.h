#pragma once
// A choice between two lights.
#include "reference/grid.h"

namespace facet::reference {

/// The fill of a choice between two by what they can send to a point, made of that of the choice
/// before.
[[nodiscard]] constexpr std::uint32_t next_fill(std::uint32_t fill) {
  return fill * 747796405U + 2891336453U;
}

/// Probability of the first of two by weights that are not both 0: that of the lesser one has seven
/// significant bits and is at least 2^-17, if it is not 0. kind, item: of the decision how it is
/// rounded.
template <typename Real, typename Probe>
[[nodiscard]] double share_of_first(Real first, Real second, DecisionKind kind, std::uint64_t item,
                                    Probe& probe) {
  const Real lesser = std::min(first, second) / (first + second);
  double share = 0;
  if (lesser > 0) {
    const int bits = 6 - std::ilogb(lesser);
    const Real rounded = decided_floor(std::ldexp(lesser, bits) + static_cast<Real>(0.5), Real(64),
                                       kind, item, probe);
    share = std::max(std::ldexp(static_cast<double>(rounded), -bits), std::ldexp(1.0, -17));
  }
  return first < second ? share : 1 - share;
}

}  // namespace facet::reference
