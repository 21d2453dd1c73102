#pragma once
#include "reference/bsdf/fresnel.h"
#include "reference/bsdf/microfacets.h"
#include "reference/bsdf/multiscatter.h"
#include "reference/bsdf/sample.h"
#include "scene/bsdf/roughconductor.h"

namespace facet::reference {

/// Torrance and Sparrow's lobe with Schlick's Fresnel term, or that of a conductor.
template <typename Real>
class RoughConductor {
 public:
  static constexpr bool transmits = false;

  template <typename Parameters>
  RoughConductor(const bsdf::RoughConductor& p, Parameters& at, LobeSampling sampling)
      : r0_(at.color(p.r0)),
        alpha_(at.roughness(p.alpha)),
        microfacets_(alpha_, p.options, sampling),
        options_(p.options),
        multiscatter_(p.multiscatter),
        ior_(p.ior()) {}

  [[nodiscard]] bool delta() const { return false; }

  template <typename Probe>
  Vec3<Real> eval(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    const HalfVector<Real> half(wo, wi);
    const Real g = microfacets_.masking(wo, wi, probe);
    const Real lobe = microfacets_.density(half.sum, probe) * g / (4 * wi.z * wo.z);
    return reflectance(half.cosine) * gain(wo) * lobe;
  }

  template <typename Probe>
  Real pdf(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    return reflected_pdf(wo, HalfVector<Real>(wo, wi), probe);
  }

  template <typename Probe>
  BsdfSample<Real> sample(const Vec3<Real>& wo, const BsdfNumbers& n, Probe& probe) const {
    const Vec3<Real> h = microfacets_.sample_half_vector(wo, n.u<Real>(), n.v<Real>(), probe);
    const HalfVector<Real> half(h, glm::dot(wo, h));
    const Vec3<Real> wi = half.reflect(wo);
    if (!is_above(wi, probe)) return {wi, 0, Vec3<Real>(0)};
    const Real weight = microfacets_.half_vector_weight(wo, wi, h, half.cosine, probe);
    return {wi, reflected_pdf(wo, half, probe), reflectance(half.cosine) * gain(wo) * weight};
  }

 private:
  template <typename Probe>
  Real reflected_pdf(const Vec3<Real>& wo, const HalfVector<Real>& half, Probe& probe) const {
    const Real d = microfacets_.density(half.sum, probe);
    return microfacets_.half_vector_pdf_over_cosine(wo, half.unit_h, half.cosine, d) / 4;
  }

  [[nodiscard]] Vec3<Real> reflectance(Real cosine) const {
    if (!ior_) return schlick(r0_, cosine);
    Vec3<Real> f;
    for (int i = 0; i < 3; ++i)
      f[i] = conductor_reflectance(Real(ior_->eta[i]), Real(ior_->k[i]), std::min(cosine, Real(1)));
    return f;
  }

  /// What multiple scattering gives back.
  [[nodiscard]] Vec3<Real> gain(const Vec3<Real>& wo) const {
    if (!multiscatter_) return Vec3<Real>(1);
    const Real lossless = lossless_albedo(options_, alpha_, wo.z);
    return Real(1) + reflectance(1) * (1 / lossless - 1);
  }

  Vec3<Real> r0_;
  Real alpha_;
  Microfacets<Real> microfacets_;
  bsdf::MicrofacetOptions options_;
  bool multiscatter_;
  std::optional<facet::ConductorIor> ior_;
};

}  // namespace facet::reference
