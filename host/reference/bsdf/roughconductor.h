#pragma once
#include "reference/bsdf/fresnel.h"
#include "reference/bsdf/microfacets.h"
#include "reference/bsdf/multiscatter.h"
#include "reference/bsdf/sample.h"
#include "scene/bsdf/roughconductor.h"

namespace facet::reference {

/// Torrance and Sparrow's lobe with Schlick's Fresnel term.
template <typename Real>
class RoughConductor {
 public:
  static constexpr bool transmits = false;

  template <typename Parameters>
  RoughConductor(const bsdf::RoughConductor& p, Parameters& at, LobeSampling sampling)
      : RoughConductor(p, at.color(p.r0), at.roughness(p.alpha), sampling) {}

  [[nodiscard]] bool delta() const { return false; }

  template <typename Probe>
  Vec3<Real> eval(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    const HalfVector<Real> half(wo, wi);
    const Real g = microfacets_.masking(wo, wi, probe);
    const Real lobe = microfacets_.density(half.sum, probe) * g / (4 * wi.z * wo.z);
    return schlick(r0_, half.cosine) * multiscatter_.factor(wo.z, r0_) * lobe;
  }

  template <typename Probe>
  Real pdf(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    return reflected_pdf(wo, HalfVector<Real>(wo, wi), probe);
  }

  template <typename Probe>
  BsdfSample<Real> sample(const Vec3<Real>& wo, const BsdfNumbers<Real>& n, Probe& probe) const {
    const Vec3<Real> h = microfacets_.sample_half_vector(wo, n.u, n.v, probe);
    const HalfVector<Real> half(h, glm::dot(wo, h));
    const Vec3<Real> wi = half.reflect(wo);
    if (!is_above(wi, probe)) return {wi, 0, Vec3<Real>(0)};
    const Real weight = microfacets_.half_vector_weight(wo, wi, h, half.cosine, probe);
    return {wi, reflected_pdf(wo, half, probe),
            schlick(r0_, half.cosine) * multiscatter_.factor(wo.z, r0_) * weight};
  }

 private:
  RoughConductor(const bsdf::RoughConductor& p, const Vec3<Real>& r0, Real alpha, LobeSampling sampling)
      : r0_(r0), microfacets_(alpha, p.options, sampling), multiscatter_(p.options, alpha, p.multiscatter) {}

  template <typename Probe>
  Real reflected_pdf(const Vec3<Real>& wo, const HalfVector<Real>& half, Probe& probe) const {
    const Real d = microfacets_.density(half.sum, probe);
    return microfacets_.half_vector_pdf_over_cosine(wo, half.unit_h, half.cosine, d) / 4;
  }

  Vec3<Real> r0_;
  Microfacets<Real> microfacets_;
  Multiscatter<Real> multiscatter_;
};

}  // namespace facet::reference
