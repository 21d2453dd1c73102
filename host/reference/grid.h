#pragma once
// Where a coordinate falls among borders at whole numbers.
#include "reference/probe.h"

namespace facet::reference {

/// Largest integer up to x, as a decision whose margin is relative to `size`.
template <typename Real, typename Probe>
[[nodiscard]] Real decided_floor(Real x, Real size, DecisionKind kind, std::uint64_t item,
                                 Probe& probe) {
  const Real border = std::nearbyint(x);
  const auto margin = static_cast<double>((x - border) / size);
  return probe.decide(kind, item, x >= border, margin) ? border : border - 1;
}

/// x modulo count, in [0, count).
[[nodiscard]] inline std::size_t wrapped(long long x, int count) {
  return static_cast<std::size_t>((x % count + count) % count);
}

}  // namespace facet::reference
