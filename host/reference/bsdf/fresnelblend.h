#pragma once
#include "reference/bsdf/two_lobes.h"
#include "scene/bsdf/fresnelblend.h"

namespace facet::reference {

template <typename Real>
struct FresnelBlendLobes {
  template <typename Parameters>
  FresnelBlendLobes(const bsdf::FresnelBlend& p, Parameters& at, LobeSampling sampling)
      : rs(at.color(p.rs)),
        under(at.color(p.rd) * (Vec3<Real>(1) - rs)),
        microfacets(at.roughness(p.alpha), p.options, sampling) {}

  Vec3<Real> base(const Vec3<Real>& wo, const Vec3<Real>& wi) const {
    return under * diffuse_under_gloss(wo, wi);
  }

  /// No masking: the larger cosine alone keeps it finite.
  template <typename Probe>
  Vec3<Real> coat(const Vec3<Real>& wo, const Vec3<Real>& wi, const HalfVector<Real>& half,
                  Probe& /*probe*/) const {
    return schlick(rs, half.cosine) * (wi.z / (4 * half.cosine * std::max(wi.z, wo.z)));
  }

  template <typename Probe>
  Real coat_albedo(const Vec3<Real>& wo, Probe& /*probe*/) const {
    return mean_channel(schlick(rs, wo.z));
  }
  Real base_albedo(const Vec3<Real>& wo) const {
    return mean_channel(under) * diffuse_falloff(wo.z);
  }

  Vec3<Real> rs;
  Vec3<Real> under;
  Microfacets<Real> microfacets;
};

/// M. Ashikhmin and P. Shirley's model (2000) with an isotropic lobe, as PBRT's FresnelBlend.
template <typename Real>
using FresnelBlend = TwoLobes<Real, FresnelBlendLobes<Real>>;

}  // namespace facet::reference
