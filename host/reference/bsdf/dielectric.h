#pragma once
#include "reference/bsdf/interface.h"
#include "reference/bsdf/sample.h"
#include "scene/bsdf/dielectric.h"
#include "scene/settings.h"

namespace facet::reference {

/// A smooth interface of two dielectrics: reflects or refracts into one direction each.
template <typename Real>
class Dielectric : public DeltaLobes<Real> {
 public:
  static constexpr bool transmits = true;

  template <typename Parameters>
  Dielectric(const bsdf::Dielectric& p, Parameters& /*at*/, LobeSampling /*sampling*/)
      : interface_{p.ext_ior, p.int_ior} {}

  void turn_over() { interface_.turn_over(); }
  /// (eta_i/eta_o)^2 of a refraction.
  [[nodiscard]] Real eta2() const { return interface_.eta2(); }

  template <typename Probe>
  BsdfSample<Real> sample(const Vec3<Real>& wo, BsdfNumbers n, Probe& probe) const {
    const Real f = interface_.reflectance(wo.z, 0, probe);
    if (n.choose_first(f, probe)) return {{-wo.x, -wo.y, wo.z}, delta_pdf<Real>, Vec3<Real>(1)};
    const Real e = interface_.ratio();
    const Real cosine = interface_.refracted_cosine(wo.x * wo.x + wo.y * wo.y, probe);
    return {{-e * wo.x, -e * wo.y, -cosine}, delta_pdf<Real>, Vec3<Real>(e * e), eta2()};
  }

 private:
  Interface<Real> interface_;
};

}  // namespace facet::reference
