#pragma once
// A rough coat above a diffuse base: what all BSDFs of two lobes do alike.
#include "reference/bsdf/fresnel.h"
#include "reference/bsdf/microfacets.h"
#include "reference/bsdf/sample.h"

namespace facet::reference {

/// 1 - (1 - c/2)^5, M. Ashikhmin and P. Shirley 2000.
template <typename Real>
[[nodiscard]] Real diffuse_falloff(Real c) {
  return -std::expm1(5 * std::log1p(-c / 2));
}

/// 28/(23 pi) (1 - (1 - cos_i/2)^5) (1 - (1 - cos_o/2)^5), of the same paper.
template <typename Real>
[[nodiscard]] Real diffuse_under_gloss(const Vec3<Real>& wo, const Vec3<Real>& wi) {
  return 28 / (23 * pi<Real>)*diffuse_falloff(wi.z) * diffuse_falloff(wo.z);
}

template <typename Real>
[[nodiscard]] Real mean_channel(const Vec3<Real>& c) {
  return (c.r + c.g + c.b) / 3;
}

/// Lobes holds the parameters and says
///   base(wo, wi): value of the base, sr^-1;
///   coat(wo, wi, half, probe): value of the coat times cos_i, over D;
///   coat_albedo(wo, probe), base_albedo(wo): by which a lobe is chosen;
///   microfacets: those of the coat.
template <typename Real, typename Lobes>
class TwoLobes {
 public:
  static constexpr bool transmits = false;

  template <typename BsdfParameters, typename Parameters>
  TwoLobes(const BsdfParameters& p, Parameters& at, LobeSampling sampling)
      : lobes_(p, at, sampling) {}

  [[nodiscard]] bool delta() const { return false; }

  template <typename Probe>
  Vec3<Real> eval(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    const HalfVector<Real> half(wo, wi);
    const Real d = lobes_.microfacets.density(half.sum, probe);
    return lobes_.base(wo, wi) + lobes_.coat(wo, wi, half, probe) * (d / wi.z);
  }

  template <typename Probe>
  Real pdf(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    const HalfVector<Real> half(wo, wi);
    const Real d = lobes_.microfacets.density(half.sum, probe);
    return mixed_pdf(wo, wi, half, d, coat_probability(wo, probe));
  }

  template <typename Probe>
  BsdfSample<Real> sample(const Vec3<Real>& wo, BsdfNumbers n, Probe& probe) const {
    const Real p = coat_probability(wo, probe);
    if (!n.choose_first(p, probe)) {
      const Vec3<Real> wi = cosine_direction(n.u<Real>(), n.v<Real>());
      return weighted(wo, wi, HalfVector<Real>(wo, wi), p, probe);
    }
    const Vec3<Real> h = lobes_.microfacets.sample_half_vector(wo, n.u<Real>(), n.v<Real>(), probe);
    const HalfVector<Real> half(h, glm::dot(wo, h));
    const Vec3<Real> wi = half.reflect(wo);
    if (!is_above(wi, probe)) return {wi, 0, Vec3<Real>(0)};
    return weighted(wo, wi, half, p, probe);
  }

 private:
  template <typename Probe>
  BsdfSample<Real> weighted(const Vec3<Real>& wo, const Vec3<Real>& wi,
                            const HalfVector<Real>& half, Real p, Probe& probe) const {
    const Real d = lobes_.microfacets.density(half.sum, probe);
    const Real density = mixed_pdf(wo, wi, half, d, p);
    if (!(density > 0)) return {wi, 0, Vec3<Real>(0)};
    const Vec3<Real> value = lobes_.base(wo, wi) * wi.z + lobes_.coat(wo, wi, half, probe) * d;
    return {wi, density, value / density};
  }

  Real mixed_pdf(const Vec3<Real>& wo, const Vec3<Real>& wi, const HalfVector<Real>& half, Real d,
                 Real p) const {
    const Real coat =
        lobes_.microfacets.half_vector_pdf_over_cosine(wo, half.unit_h, half.cosine, d) / 4;
    return p * coat + (1 - p) * wi.z / pi<Real>;
  }

  /// By the lobes' albedos.
  template <typename Probe>
  Real coat_probability(const Vec3<Real>& wo, Probe& probe) const {
    const Real coat = lobes_.coat_albedo(wo, probe);
    const Real base = lobes_.base_albedo(wo);
    if (coat <= 0) return 0;
    if (base <= 0) return 1;
    // Of tiny shares, the quotient may round to 0 or 1.
    constexpr Real step = Real(1) / 16777216;
    return within_reach(std::clamp(coat / (coat + base), step, 1 - step));
  }

  Lobes lobes_;
};

}  // namespace facet::reference
