#pragma once
#include "reference/real.h"
#include "scene/bsdf/albedo_table.h"

namespace facet::reference {

/// What light that microfacets reflect several times adds to a conductor: E. Turquin, "Practical multiple
/// scattering compensation for microfacet models", 2019.
template <typename Real>
class Multiscatter {
 public:
  Multiscatter(const bsdf::MicrofacetOptions& options, Real alpha, bool wanted)
      : table_(wanted ? &albedo_table(options) : nullptr), row_(alpha) {}

  /// Factor on the value; r0: reflectance at normal incidence.
  [[nodiscard]] Vec3<Real> factor(Real cos_o, const Vec3<Real>& r0) const {
    if (table_ == nullptr) return Vec3<Real>(1);
    const Place x(cos_o);
    const Real e = along(row_.first, x) * (1 - row_.share) + along(row_.first + 1, x) * row_.share;
    return Vec3<Real>(1) + r0 * ((1 - e) / e);
  }

 private:
  /// Between which nodes a cosine or a roughness lies.
  struct Place {
    std::size_t first;
    Real share;

    explicit Place(Real value) {
      constexpr auto last = bsdf::albedo_nodes - 1;
      const Real at = std::sqrt(value) * static_cast<Real>(last);
      first = std::min(static_cast<std::size_t>(at), last - 1);
      share = at - static_cast<Real>(first);
    }
  };

  [[nodiscard]] Real along(std::size_t row, const Place& x) const {
    const auto node = [&](std::size_t column) { return Real((*table_)[row * bsdf::albedo_nodes + column]); };
    return node(x.first) * (1 - x.share) + node(x.first + 1) * x.share;
  }

  const bsdf::AlbedoTable* table_;
  Place row_;
};

}  // namespace facet::reference
