#pragma once
// The Beckmann microfacet distribution in terms of slopes: the NDF is that of a normal law of
// slopes of variance alpha^2/2 along each axis. P. Beckmann, A. Spizzichino 1963; B. Walter et al.
// 2007; E. Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT
// 3(2), 2014.
#include "reference/bsdf/normal_law.h"
#include "reference/probe.h"

namespace facet::reference {

template <typename Real>
class Beckmann {
 public:
  explicit Beckmann(Real alpha) : alpha_(alpha) {}

  /// D(h) in sr^-1 for a vector h of any length: the density of the slope -h.xy/h.z over cos^4.
  template <typename Probe>
  Real density(const Vec3<Real>& h, Probe& probe) const {
    if (!(h.z > 0)) return 0;
    const Real tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z);
    const Real exponent = probe.nudged(tan2 / (alpha_ * alpha_));
    // docs/reference/sampling.md: D is 0 from an exponent of 87 on.
    if (probe.reaches(DecisionKind::tail, exponent, 87)) return 0;
    const Real slope_density = std::exp(-exponent) / (pi<Real> * alpha_ * alpha_);
    return slope_density * (1 + tan2) * (1 + tan2);
  }

  /// Walter's rational G1 for a direction of either side. which: number of the decision.
  template <typename Probe>
  Real rational_masking(const Vec3<Real>& w, std::uint64_t which, Probe& probe) const {
    const Real b = probe.nudged(inverse_slope(w));
    if (probe.reaches(DecisionKind::masking, b, 1.6, which)) return 1;
    const Real numerator = Real(3.535) * b + Real(2.181) * (b * b);
    return numerator / (1 + Real(2.276) * b + Real(2.577) * (b * b));
  }

  /// G1 of the distribution itself, 1/(1 + Lambda): what normalises the visible normals.
  Real exact_masking(const Vec3<Real>& w) const {
    const Real b = inverse_slope(w);
    if (!(b < 10)) return 1;
    const Real gauss = std::exp(-b * b) * std::numbers::inv_sqrtpi_v<Real>;
    return 1 / (1 + (gauss / b - std::erfc(b)) / 2);
  }

  /// Half vector of density D cos, unit.
  template <typename Probe>
  Vec3<Real> sample_density(Real u, Real v, Probe& /*probe*/) const {
    Real sine = 0;
    Real cosine = 0;
    sin_cos_turns(v, sine, cosine);
    const Real tangent = alpha_ * std::sqrt(-std::log1p(-u));
    return unit(Vec3<Real>(tangent * cosine, tangent * sine, 1));
  }

  /// Half vector of the density of the normals visible from wo, unit.
  template <typename Probe>
  Vec3<Real> sample_visible(const Vec3<Real>& wo, Real u, Real v, Probe& probe) const {
    constexpr Real least = Real(1) / 33554432;  // 2^-25
    // Stretched to roughness 1, seen from w.
    const Vec3<Real> w = probe.nudged(unit(Vec3<Real>(alpha_ * wo.x, alpha_ * wo.y, wo.z)));
    const Real sine = std::hypot(w.x, w.y);
    const Real ex = sine > 0 ? w.x / sine : Real(1);
    const Real ey = sine > 0 ? w.y / sine : Real(0);
    const VisibleSlopes<Real> slopes(sine, w.z);
    const Real along = nudged_slope(slopes.quantile(probe.nudged(std::max(u, least))), probe);
    const Real across = nudged_slope(normal_quantile(std::max(v, least)), probe);
    return unit(
        Vec3<Real>(-alpha_ * (ex * along - ey * across), -alpha_ * (ey * along + ex * across), 1));
  }

 private:
  /// 1/(alpha tan(theta)).
  Real inverse_slope(const Vec3<Real>& w) const {
    return std::abs(w.z) / (alpha_ * std::hypot(w.x, w.y));
  }

  /// Slopes carry an error relative to 1 and to themselves.
  template <typename Probe>
  static Real nudged_slope(Real x, Probe& probe) {
    const Real nudge = probe.nudged(Real(1)) - 1;
    return x + nudge * (1 + std::abs(x));
  }

  Real alpha_;
};

}  // namespace facet::reference
