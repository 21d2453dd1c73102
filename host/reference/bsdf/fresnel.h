#pragma once
// Reflectances.
#include <algorithm>
#include <complex>

#include "reference/probe.h"
#include "reference/real.h"

namespace facet::reference {

/// C. Schlick 1994.
template <typename Real>
[[nodiscard]] Vec3<Real> schlick(const Vec3<Real>& r0, Real cosine) {
  const Real m = std::max(1 - cosine, Real(0));
  const Real m5 = m * m * m * m * m;
  return r0 * (1 - m5) + Vec3<Real>(m5);
}

/// Unpolarised reflectance of a conductor of index eta + i k at cosine c, from Snell's law and the amplitudes
/// in complex numbers.
template <typename Real>
[[nodiscard]] Real conductor_reflectance(Real eta, Real k, Real c) {
  using Complex = std::complex<Real>;
  const Complex n(eta, k);
  const Complex t = std::sqrt(Real(1) - (1 - c) * (1 + c) / (n * n));
  const Complex perpendicular = (c - n * t) / (c + n * t);
  const Complex parallel = (n * c - t) / (n * c + t);
  return (std::norm(perpendicular) + std::norm(parallel)) / 2;
}

/// Unpolarised reflectance for light that arrives at cosine c >= 0 from the side of index `from`, in the form
/// of R. Cook and K. Torrance 1982 (also B. Walter et al. 2007, eq. 22) with g - c written as (g^2 - c^2)/(g
/// + c), so that nearly equal indices keep their digits.
template <typename Real, typename Probe>
[[nodiscard]] Real dielectric_reflectance(Real c, Real from, Real to, std::uint64_t which, Probe& probe) {
  if (from == to) return 0;
  const Real excess = (to - from) * (to + from) / (from * from);  // eta^2 - 1
  const Real g2 = excess + c * c;
  if (probe.decide(DecisionKind::reflectance, which, g2 <= 0, static_cast<double>(g2))) return 1;
  const Real g = std::sqrt(std::max(g2, Real(0)));
  const Real sum = g + c;
  const Real difference = excess / sum;
  const Real perpendicular = difference / sum;
  const Real ratio = (c * sum - 1) / (c * difference + 1);
  return std::min(perpendicular * perpendicular * (1 + ratio * ratio) / 2, Real(1));
}

}  // namespace facet::reference
