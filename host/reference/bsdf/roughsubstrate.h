#pragma once
#include "reference/bsdf/interface.h"
#include "reference/bsdf/two_lobes.h"
#include "scene/bsdf/roughsubstrate.h"

namespace facet::reference {

template <typename Real>
struct RoughSubstrateLobes {
  template <typename Parameters>
  RoughSubstrateLobes(const bsdf::RoughSubstrate& p, Parameters& at, LobeSampling sampling)
      : interface {
    p.ext_ior, p.int_ior
  }, kd(at.color(p.kd)), microfacets(at.roughness(p.alpha), p.options, sampling) {
    const Real root = (interface.outer - interface.inner) / (interface.outer + interface.inner);
    transmitted = 1 - root * root;
  }

  Vec3<Real> base(const Vec3<Real>& wo, const Vec3<Real>& wi) const {
    return kd * (transmitted * diffuse_under_gloss(wo, wi));
  }

  template <typename Probe>
  Vec3<Real> coat(const Vec3<Real>& wo, const Vec3<Real>& wi, const HalfVector<Real>& half,
                  Probe& probe) const {
    const Real f = interface.reflectance(half.cosine, 0, probe);
    return Vec3<Real>(f * microfacets.masking(wo, wi, probe) / (4 * wo.z));
  }

  template <typename Probe>
  Real coat_albedo(const Vec3<Real>& wo, Probe& probe) const {
    return interface.reflectance(wo.z, 1, probe);
  }
  Real base_albedo(const Vec3<Real>& wo) const {
    return mean_channel(kd) * transmitted * diffuse_falloff(wo.z);
  }

  Interface<Real> interface;
  Vec3<Real> kd;
  Microfacets<Real> microfacets;
  Real transmitted = 1;
};

/// M. Ashikhmin and P. Shirley's diffuse base (2000) under a rough coat with the exact dielectric
/// reflectance.
template <typename Real>
using RoughSubstrate = TwoLobes<Real, RoughSubstrateLobes<Real>>;

}  // namespace facet::reference
