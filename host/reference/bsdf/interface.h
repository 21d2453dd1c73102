#pragma once
// The border of two dielectrics, seen from one side.
#include "reference/bsdf/fresnel.h"

namespace facet::reference {

template <typename Real>
struct Interface {
  Real outer;  ///< index of refraction on the side of wo, above
  Real inner;

  /// Where light arrives from above at cosine c. which: number of the decision.
  template <typename Probe>
  [[nodiscard]] InterfaceShares<Real> shares(Real c, std::uint64_t which, Probe& probe) const {
    return dielectric_shares(std::min(c, Real(1)), outer, inner, which, probe);
  }
  template <typename Probe>
  [[nodiscard]] Real reflectance(Real c, std::uint64_t which, Probe& probe) const {
    return shares(c, which, probe).reflected;
  }

  [[nodiscard]] bool is_none() const { return outer == inner; }
  /// eta_o/eta_i of a refraction.
  [[nodiscard]] Real ratio() const { return outer / inner; }
  /// (eta_i/eta_o)^2.
  [[nodiscard]] Real eta2() const { return 1 / (ratio() * ratio()); }
  [[nodiscard]] Real ratio2_less_1() const {
    return (outer - inner) * (outer + inner) / (inner * inner);
  }
  void turn_over() { std::swap(outer, inner); }

  /// The cosine beyond the surface where 1 - c^2 = sine2 before it; 0 beyond the critical angle.
  template <typename Probe>
  [[nodiscard]] Real refracted_cosine(Real sine2, Probe& probe) const {
    const Real beyond = probe.nudged(ratio() * ratio() * sine2);
    return std::sqrt(std::max(1 - beyond, Real(0)));
  }
};

}  // namespace facet::reference
