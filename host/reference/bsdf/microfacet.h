#pragma once
#include "reference/bsdf/interface.h"
#include "reference/bsdf/two_lobes.h"
#include "scene/bsdf/microfacet.h"

namespace facet::reference {

template <typename Real>
struct MicrofacetLobes {
  template <typename Parameters>
  MicrofacetLobes(const bsdf::Microfacet& p, Parameters& /*at*/, LobeSampling sampling)
      : interface {
    p.ext_ior, p.int_ior
  }, kd(p.kd), microfacets(p.alpha, p.options, sampling) {
    ks = 1 - std::max({kd.r, kd.g, kd.b});
  }

  Vec3<Real> base(const Vec3<Real>& /*wo*/, const Vec3<Real>& /*wi*/) const {
    return kd / pi<Real>;
  }

  template <typename Probe>
  Vec3<Real> coat(const Vec3<Real>& wo, const Vec3<Real>& wi, const HalfVector<Real>& half,
                  Probe& probe) const {
    const Real f = interface.reflectance(half.cosine, 0, probe);
    return Vec3<Real>(ks * f * microfacets.masking(wo, wi, probe) / (4 * wo.z));
  }

  template <typename Probe>
  Real coat_albedo(const Vec3<Real>& wo, Probe& probe) const {
    return ks * interface.reflectance(wo.z, 1, probe);
  }
  Real base_albedo(const Vec3<Real>& /*wo*/) const { return mean_channel(kd); }

  Interface<Real> interface;
  Vec3<Real> kd;
  Microfacets<Real> microfacets;
  Real ks = 0;
};

/// Nori's rough plastic: Lambert's reflection and a coat that takes what is left of the largest
/// channel.
template <typename Real>
using Microfacet = TwoLobes<Real, MicrofacetLobes<Real>>;

}  // namespace facet::reference
