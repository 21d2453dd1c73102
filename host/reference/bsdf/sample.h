#pragma once
// What sampling a BSDF gives. Directions are unit, in the shading frame, z along the shading
// normal.
#include "reference/probe.h"
#include "reference/real.h"
#include "shared/records.h"

namespace facet::reference {

/// Stands for the density of a delta lobe.
template <typename Real>
inline constexpr Real delta_pdf = static_cast<Real>(shared::DELTA_PDF);

template <typename Real>
struct BsdfSample {
  Vec3<Real> wi{0, 0, 1};
  Real pdf = 0;          ///< sr^-1, or delta_pdf
  Vec3<Real> weight{0};  ///< f cos / pdf; 0 where the sample is rejected
  Real eta2 = 1;         ///< (eta_i/eta_o)^2 of a refraction
};

/// Base of models that scatter into single directions only: between any two there is nothing.
template <typename Real>
struct DeltaLobes {
  [[nodiscard]] bool delta() const { return true; }
  template <typename Probe>
  Vec3<Real> eval(const Vec3<Real>& /*wo*/, const Vec3<Real>& /*wi*/, Probe& /*probe*/) const {
    return Vec3<Real>(0);
  }
  template <typename Probe>
  Real pdf(const Vec3<Real>& /*wo*/, const Vec3<Real>& /*wi*/, Probe& /*probe*/) const {
    return 0;
  }
};

/// Numbers of a BSDF sample (docs/sampling.md, "BSDF sample").
template <typename Real>
struct BsdfNumbers {
  Real lobe = 0;
  Real u = 0;
  Real v = 0;
};

/// Whether a direction lies above the surface.
template <typename Real, typename Probe>
[[nodiscard]] bool is_above(const Vec3<Real>& w, Probe& probe) {
  return probe.positive(DecisionKind::horizon, w.z);
}

/// A probability p within reach of a number of 24 bits from both sides, unless one side has no
/// value.
template <typename Real>
[[nodiscard]] Real within_reach(Real p) {
  constexpr Real step = Real(1) / 16777216;
  if (!(p > 0 && p < 1)) return p;
  return std::clamp(p, step, 1 - step);
}

/// Direction with density cos/pi.
template <typename Real>
[[nodiscard]] Vec3<Real> cosine_direction(Real u, Real v) {
  Real sine = 0;
  Real cosine = 0;
  sin_cos_turns(v, sine, cosine);
  const Real radius = std::sqrt(u);
  return {radius * cosine, radius * sine, std::sqrt(1 - u)};
}

/// Direction with equal density over the upper hemisphere (height 1) or the sphere (height 2).
template <typename Real>
[[nodiscard]] Vec3<Real> uniform_direction(Real u, Real v, Real height) {
  Real sine = 0;
  Real cosine = 0;
  sin_cos_turns(v, sine, cosine);
  const Real z = 1 - height * u;
  const Real radius = std::sqrt(height * u * (1 + z));
  return {radius * cosine, radius * sine, z};
}

}  // namespace facet::reference
