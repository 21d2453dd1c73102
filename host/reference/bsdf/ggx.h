#pragma once
// The GGX microfacet distribution: normals of an ellipsoid of half axes alpha, alpha, 1. B. Walter
// et al. 2007; J. Dupuy and A. Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023.
#include "reference/probe.h"
#include "reference/real.h"

namespace facet::reference {

template <typename Real>
class Ggx {
 public:
  explicit Ggx(Real alpha) : alpha_(alpha) {}

  /// D(h) in sr^-1 for a vector h of any length: the square of alpha |h|^2/(alpha^2 h.z^2 + h.x^2 +
  /// h.y^2), a sum that does not cancel, over pi.
  template <typename Probe>
  Real density(const Vec3<Real>& h, Probe& probe) const {
    if (!(h.z > 0)) return 0;
    const Real across2 = h.x * h.x + h.y * h.y;
    const Real up = alpha_ * h.z;
    const Real root = probe.nudged(alpha_ * (across2 + h.z * h.z) / (across2 + up * up));
    return root * root / pi<Real>;
  }

  /// Smith's G1 for a direction of either side: both masking and what normalises the visible
  /// normals.
  Real exact_masking(const Vec3<Real>& w) const {
    const Real z = std::abs(w.z);
    const Real across = alpha_ * std::hypot(w.x, w.y);
    return 2 * z / (z + std::hypot(z, across));
  }

  /// Half vector of density D cos, unit.
  template <typename Probe>
  Vec3<Real> sample_density(Real u, Real v, Probe& probe) const {
    Real sine = 0;
    Real cosine = 0;
    sin_cos_turns(v, sine, cosine);
    const Real tangent = probe.nudged(alpha_ * std::sqrt(u / (1 - u)));
    return unit(Vec3<Real>(tangent * cosine, tangent * sine, 1));
  }

  /// Half vector of the density of the normals visible from wo, unit: w, the view of the sphere
  /// into which the ellipsoid is stretched, plus a point of the cap of that sphere which the
  /// horizon does not hide.
  template <typename Probe>
  Vec3<Real> sample_visible(const Vec3<Real>& wo, Real u, Real v, Probe& probe) const {
    const Vec3<Real> w = probe.nudged(unit(Vec3<Real>(alpha_ * wo.x, alpha_ * wo.y, wo.z)));
    Real sine = 0;
    Real cosine = 0;
    sin_cos_turns(v, sine, cosine);
    const Real t = u * (1 + w.z);
    const Real radius = std::sqrt(std::max(t * (2 - t), Real(0)));
    const Vec3<Real> cap = probe.nudged(Vec3<Real>(radius * cosine, radius * sine, 0));
    const Real z = (1 - u) * (1 + w.z);
    return unit(Vec3<Real>(alpha_ * (cap.x + w.x), alpha_ * (cap.y + w.y), z));
  }

 private:
  Real alpha_;
};

}  // namespace facet::reference
