#pragma once
#include "reference/bsdf/sample.h"
#include "scene/bsdf/mirror.h"
#include "scene/settings.h"

namespace facet::reference {

/// Reflects everything into one direction.
template <typename Real>
class Mirror : public DeltaLobes<Real> {
 public:
  static constexpr bool transmits = false;

  template <typename Parameters>
  Mirror(const bsdf::Mirror& /*p*/, Parameters& /*at*/, LobeSampling /*sampling*/) {}

  template <typename Probe>
  BsdfSample<Real> sample(const Vec3<Real>& wo, const BsdfNumbers& /*n*/, Probe& /*probe*/) const {
    return {{-wo.x, -wo.y, wo.z}, delta_pdf<Real>, Vec3<Real>(1)};
  }
};

}  // namespace facet::reference
