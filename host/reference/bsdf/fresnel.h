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

/// Shares of the light that meets an interface.
template <typename Real>
struct InterfaceShares {
  Real reflected;
  Real transmitted;
};

/// Unpolarised, for light that arrives at cosine c >= 0 from the side of index `from`, in the form
/// of R. Cook and K. Torrance 1982 (also B. Walter et al. 2007, eq. 22) with g - c written as (g^2
/// - c^2)/(g + c), so that nearly equal indices keep their digits. The transmittance is the sum of
/// those of both polarisations, 4 c g/(g + c)^2 and that times (eta/(c (g - c) + 1))^2, and keeps
/// its digits where nearly all is reflected.
template <typename Real, typename Probe>
[[nodiscard]] InterfaceShares<Real> dielectric_shares(Real c, Real from, Real to,
                                                      std::uint64_t which, Probe& probe) {
  if (from == to) return {0, 1};
  const Real excess = (to - from) * (to + from) / (from * from);  // eta^2 - 1
  const Real g2 = excess + c * c;
  if (!probe.positive(DecisionKind::reflectance, g2, which)) return {1, 0};
  const Real g = std::sqrt(std::max(g2, Real(0)));
  const Real sum = g + c;
  const Real difference = excess / sum;
  const Real perpendicular = difference / sum;
  const Real below = c * difference + 1;
  const Real ratio = (c * sum - 1) / below;
  const Real eta = to / from;
  const Real reflected = perpendicular * perpendicular * (1 + ratio * ratio) / 2;
  const Real transmitted = 2 * c * g / (sum * sum) * (1 + eta * eta / (below * below));
  return {std::min(reflected, Real(1)), std::min(transmitted, Real(1))};
}

/// Unpolarised reflectance of a conductor of index n = eta + i k at cosine c > 0, from Fresnel's
/// amplitudes: with q = sqrt(n^2 - s^2) they are (1 - n^2)/(c + q)^2 and that times (c q - s^2)/(c
/// q + s^2), s^2 = 1 - c^2. 0 where the indices are equal.
template <typename Real>
[[nodiscard]] Real conductor_reflectance(Real eta, Real k, Real c) {
  using Complex = std::complex<Real>;
  const Real s2 = std::max((1 - c) * (1 + c), Real(0));
  const Complex excess((eta - 1) * (eta + 1) - k * k, 2 * eta * k);  // n^2 - 1
  if (excess == Complex(0)) return 0;
  const Complex q = std::sqrt(excess + c * c);
  const Real perpendicular = std::norm(excess) / (std::norm(c + q) * std::norm(c + q));
  const Real ratio = std::norm(c * q - s2) / std::norm(c * q + s2);
  return std::min(perpendicular * (1 + ratio) / 2, Real(1));
}

}  // namespace facet::reference
