#pragma once
// The normal law of slopes behind the Beckmann distribution: quantiles, and the law of the visible
// slopes.
#include <algorithm>

#include "reference/real.h"

namespace facet::reference {

/// The x with erfc(-x)/2 = u: quantile of a normal variable of variance 1/2, 0 < u < 1. S.
/// Winitzki's approximation (2008), then Halley's steps on erfc of the tail that u lies in.
template <typename Real>
[[nodiscard]] Real normal_quantile(Real u) {
  // The smaller tail's mass, exact: u is a multiple of 2^-25.
  const Real q = 2 * std::min(u, 1 - u);
  if (q >= 1) return 0;
  constexpr auto a = static_cast<Real>(0.147);
  const Real l = std::log(q * (2 - q));
  const Real h = 2 / (pi<Real> * a) + l / 2;
  Real x = std::sqrt(std::max(std::sqrt(h * h - l / a) - h, Real(0)));
  const int steps = sizeof(Real) == sizeof(float) ? 2 : 3;
  for (int i = 0; i < steps; ++i) {
    // erfc'(x) = -2/sqrt(pi) exp(-x^2), erfc''/erfc' = -2 x.
    const Real newton =
        (std::erfc(x) - q) / (-2 * std::numbers::inv_sqrtpi_v<Real> * std::exp(-x * x));
    x -= newton / (1 + x * newton);
  }
  return u < Real(0.5) ? -x : x;
}

/// The visible slopes of roughness 1 along the direction of view (E. Heitz, E. d'Eon 2014), seen
/// from the polar angle of sine s and cosine c.
template <typename Real>
class VisibleSlopes {
 public:
  VisibleSlopes(Real s, Real c) : s_(s), c_(c), end_(c < 6 * s ? c / s : Real(6)) {}

  /// Mass below slope x, not normalised.
  [[nodiscard]] Real mass(Real x) const {
    return c_ * std::erfc(-x) + s_ * std::numbers::inv_sqrtpi_v<Real> * std::exp(-x * x);
  }

  /// Slope below which the share u of the mass lies, 0 < u < 1: Newton's method on the logarithm of
  /// the mass, which is concave and as steep in the tail as elsewhere; halving where a step leaves
  /// the bracket.
  [[nodiscard]] Real quantile(Real u) const {
    const Real target = u * mass(end_);
    Real low = -7;
    Real high = end_;
    Real x = std::min(s_ < Real(0.7) ? normal_quantile(u) : -std::sqrt(-std::log(u)), end_);
    for (int i = 0; i < 64; ++i) {
      const Real m = mass(x);
      (m < target ? low : high) = x;
      const Real slope = 2 * std::numbers::inv_sqrtpi_v<Real> * std::exp(-x * x) * (c_ - s_ * x);
      Real next = x - std::log(m / target) * m / slope;
      if (!(next > low && next < high)) next = low + (high - low) / 2;
      if (std::abs(next - x) <=
          std::numeric_limits<Real>::epsilon() * std::max(std::abs(x), Real(0.5)))
        return next;
      x = next;
    }
    return x;
  }

 private:
  Real s_;
  Real c_;
  Real end_;
};

}  // namespace facet::reference
