#pragma once
#include "reference/bsdf/sample.h"
#include "scene/bsdf/diffuse.h"
#include "scene/settings.h"

namespace facet::reference {

/// Lambert's reflection, f = albedo/pi.
template <typename Real>
class Diffuse {
 public:
  static constexpr bool transmits = false;

  template <typename Parameters>
  Diffuse(const bsdf::Diffuse& p, Parameters& at, LobeSampling /*sampling*/)
      : albedo_(at.color(p.albedo)) {}

  [[nodiscard]] bool delta() const { return false; }

  template <typename Probe>
  Vec3<Real> eval(const Vec3<Real>& /*wo*/, const Vec3<Real>& /*wi*/, Probe& /*probe*/) const {
    return albedo_ / pi<Real>;
  }

  template <typename Probe>
  Real pdf(const Vec3<Real>& /*wo*/, const Vec3<Real>& wi, Probe& /*probe*/) const {
    return wi.z / pi<Real>;
  }

  template <typename Probe>
  BsdfSample<Real> sample(const Vec3<Real>& /*wo*/, const BsdfNumbers& n, Probe& /*probe*/) const {
    const Vec3<Real> wi = cosine_direction(n.u<Real>(), n.v<Real>());
    return {wi, wi.z / pi<Real>, albedo_};
  }

 private:
  Vec3<Real> albedo_;
};

}  // namespace facet::reference
