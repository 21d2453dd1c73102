#pragma once
#include "reference/bsdf/beckmann.h"
#include "reference/bsdf/fresnel.h"
#include "reference/bsdf/sample.h"
#include "scene/bsdf/roughsubstrate.h"

namespace facet::reference {

/// M. Ashikhmin and P. Shirley's diffuse base (2000) under a Beckmann coat with the exact dielectric
/// reflectance.
template <typename Real>
class RoughSubstrate {
 public:
  RoughSubstrate(const bsdf::RoughSubstrate& p, LobeSampling sampling)
      : kd_(p.kd), microfacets_(p.alpha, sampling), exterior_(p.ext_ior), interior_(p.int_ior) {
    const Real root = (exterior_ - interior_) / (exterior_ + interior_);
    transmitted_ = 1 - root * root;
    mean_kd_ = (kd_.r + kd_.g + kd_.b) / 3;
  }

  template <typename Probe>
  Vec3<Real> eval(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    const HalfVector<Real> half(wo, wi);
    return base(wo, wi) + Vec3<Real>(coat_times_cosine(wo, wi, half.sum, half.cosine, probe) / wi.z);
  }

  template <typename Probe>
  Real pdf(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    const HalfVector<Real> half(wo, wi);
    const Real d = microfacets_.density(half.sum, probe);
    return mixed_pdf(wo, wi, microfacets_.reflected_pdf(wo, half.unit_h, half.cosine, d), probe);
  }

  template <typename Probe>
  BsdfSample<Real> sample(const Vec3<Real>& wo, const BsdfNumbers<Real>& n, Probe& probe) const {
    const Real p = coat_probability(wo, probe);
    const bool coat = probe.decide(DecisionKind::lobe, 0, n.lobe < p, static_cast<double>(p - n.lobe));
    if (!coat) {
      const Vec3<Real> wi = cosine_direction(n.u, n.v);
      const Real density = pdf(wo, wi, probe);
      return {wi, density, eval(wo, wi, probe) * (wi.z / density)};
    }
    const Vec3<Real> h = probe.nudged(microfacets_.sample_half_vector(wo, n.u, n.v, probe));
    const Real cosine = glm::dot(wo, h);
    const Vec3<Real> wi = 2 * cosine * h - wo;
    if (!(cosine > 0 && wi.z > 0)) return {wi, 0, Vec3<Real>(0)};
    const Real d = microfacets_.density(h, probe);
    const Real density = mixed_pdf(wo, wi, microfacets_.reflected_pdf(wo, h, cosine, d), probe);
    if (!(density > 0)) return {wi, 0, Vec3<Real>(0)};
    const Vec3<Real> value = base(wo, wi) * wi.z + Vec3<Real>(coat_times_cosine(wo, wi, h, cosine, probe));
    return {wi, density, value / density};
  }

 private:
  /// 1 - (1 - c/2)^5.
  static Real falloff(Real c) { return -std::expm1(5 * std::log1p(-c / 2)); }

  Vec3<Real> base(const Vec3<Real>& wo, const Vec3<Real>& wi) const {
    return kd_ * (28 / (23 * pi<Real>)*transmitted_ * falloff(wi.z) * falloff(wo.z));
  }

  /// The coat's value times cos_i.
  template <typename Probe>
  Real coat_times_cosine(const Vec3<Real>& wo, const Vec3<Real>& wi, const Vec3<Real>& h, Real cosine,
                         Probe& probe) const {
    const Real g = microfacets_.masking(wi, 0, probe) * microfacets_.masking(wo, 1, probe);
    return microfacets_.density(h, probe) * reflectance(cosine, 0, probe) * g / (4 * wo.z);
  }

  template <typename Probe>
  Real reflectance(Real cosine, std::uint64_t which, Probe& probe) const {
    return dielectric_reflectance(std::min(cosine, Real(1)), exterior_, interior_, which, probe);
  }

  /// By the lobes' albedos, within reach of a number of 24 bits.
  template <typename Probe>
  Real coat_probability(const Vec3<Real>& wo, Probe& probe) const {
    constexpr Real step = Real(1) / 16777216;
    const Real coat = reflectance(wo.z, 1, probe);
    const Real under = mean_kd_ * transmitted_ * falloff(wo.z);
    if (coat <= 0) return 0;
    if (under <= 0) return 1;
    return std::clamp(coat / (coat + under), step, 1 - step);
  }

  template <typename Probe>
  Real mixed_pdf(const Vec3<Real>& wo, const Vec3<Real>& wi, Real coat_pdf, Probe& probe) const {
    const Real p = coat_probability(wo, probe);
    return p * coat_pdf + (1 - p) * wi.z / pi<Real>;
  }

  Vec3<Real> kd_;
  Beckmann<Real> microfacets_;
  Real exterior_;
  Real interior_;
  Real transmitted_ = 1;
  Real mean_kd_ = 0;
};

}  // namespace facet::reference
