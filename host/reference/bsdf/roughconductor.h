#pragma once
#include "reference/bsdf/beckmann.h"
#include "reference/bsdf/fresnel.h"
#include "reference/bsdf/sample.h"
#include "scene/bsdf/roughconductor.h"

namespace facet::reference {

/// Torrance and Sparrow's lobe with Beckmann microfacets and Schlick's Fresnel term.
template <typename Real>
class RoughConductor {
 public:
  RoughConductor(const bsdf::RoughConductor& p, LobeSampling sampling)
      : r0_(p.r0), microfacets_(p.alpha, sampling) {}

  template <typename Probe>
  Vec3<Real> eval(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    const HalfVector<Real> half(wo, wi);
    const Real g = microfacets_.masking(wi, 0, probe) * microfacets_.masking(wo, 1, probe);
    const Real lobe = microfacets_.density(half.sum, probe) * g / (4 * wi.z * wo.z);
    return schlick(r0_, half.cosine) * lobe;
  }

  template <typename Probe>
  Real pdf(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    const HalfVector<Real> half(wo, wi);
    return microfacets_.reflected_pdf(wo, half.unit_h, half.cosine, microfacets_.density(half.sum, probe));
  }

  template <typename Probe>
  BsdfSample<Real> sample(const Vec3<Real>& wo, const BsdfNumbers<Real>& n, Probe& probe) const {
    const Vec3<Real> h = probe.nudged(microfacets_.sample_half_vector(wo, n.u, n.v, probe));
    const Real cosine = glm::dot(wo, h);
    const Vec3<Real> wi = 2 * cosine * h - wo;
    if (!(cosine > 0)) return {wi, 0, Vec3<Real>(0)};
    const Real weight = microfacets_.reflected_weight(wo, wi, h, cosine, probe);
    return {wi, microfacets_.reflected_pdf(wo, h, cosine, microfacets_.density(h, probe)),
            schlick(r0_, cosine) * weight};
  }

 private:
  Vec3<Real> r0_;
  Beckmann<Real> microfacets_;
};

}  // namespace facet::reference
