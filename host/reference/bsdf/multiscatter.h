#pragma once
// The light that microfacets lose between each other, given back (E. Turquin 2019).
#include "reference/real.h"
#include "scene/bsdf/albedo_table.h"

namespace facet::reference {

/// Albedo with F = 1 seen under a cosine: the table, bilinear between its nodes.
template <typename Real>
[[nodiscard]] Real lossless_albedo(const bsdf::MicrofacetOptions& options, Real alpha,
                                   Real cosine) {
  const bsdf::AlbedoTable& table = bsdf::albedo_table(options);
  constexpr std::size_t cells = bsdf::albedo_nodes - 1;
  const Real x = cosine * (1 + alpha) / (cosine + alpha) * cells;
  const Real y = std::sqrt(alpha) * cells;
  const std::size_t column = std::min(static_cast<std::size_t>(x), cells - 1);
  const std::size_t row = std::min(static_cast<std::size_t>(y), cells - 1);
  const Real fx = x - static_cast<Real>(column);
  const Real fy = y - static_cast<Real>(row);
  const auto along = [&](std::size_t r) {
    const std::size_t i = r * bsdf::albedo_nodes + column;
    return (1 - fx) * static_cast<Real>(table.at(i)) + fx * static_cast<Real>(table.at(i + 1));
  };
  return (1 - fy) * along(row) + fy * along(row + 1);
}

}  // namespace facet::reference
