#pragma once
// What sampling a BSDF gives. Directions are unit, in the shading frame, z along the shading normal.
#include "reference/real.h"

namespace facet::reference {

template <typename Real>
struct BsdfSample {
  Vec3<Real> wi{0, 0, 1};
  Real pdf = 0;          ///< sr^-1
  Vec3<Real> weight{0};  ///< f cos / pdf; 0 where the sample is rejected
};

/// Numbers of a BSDF sample (docs/sampling.md, "BSDF sample").
template <typename Real>
struct BsdfNumbers {
  Real lobe = 0;
  Real u = 0;
  Real v = 0;
};

/// Direction with density cos/pi.
template <typename Real>
[[nodiscard]] Vec3<Real> cosine_direction(Real u, Real v) {
  Real sine = 0;
  Real cosine = 0;
  sin_cos_turns(v, sine, cosine);
  const Real radius = std::sqrt(u);
  return {radius * cosine, radius * sine, std::sqrt(1 - u)};
}

/// Direction with density 1/(2 pi) over the upper hemisphere.
template <typename Real>
[[nodiscard]] Vec3<Real> uniform_direction(Real u, Real v) {
  Real sine = 0;
  Real cosine = 0;
  sin_cos_turns(v, sine, cosine);
  const Real z = 1 - u;
  const Real radius = std::sqrt(u * (1 + z));
  return {radius * cosine, radius * sine, z};
}

}  // namespace facet::reference
