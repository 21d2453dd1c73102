#pragma once
// How much light rough microfacets reflect without losing it between each other: tables that the
// build makes (cmake/generators/make_albedo_table.cpp), for the option `multiscatter`.
#include <array>

#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// Nodes along both axes: x = cos_o (1 + alpha)/(cos_o + alpha) and alpha = y^2, x and y equally
/// spaced over [0, 1]. Masking depends on the ratio of cos_o and alpha where both are small, so
/// that x keeps the albedo smooth for every alpha.
inline constexpr std::size_t albedo_nodes = shared::ALBEDO_NODES;

/// Directional albedo of D G/(4 cos_i cos_o), that is of a conductor with F = 1: [alpha][cos_o].
using AlbedoTable = std::array<float, albedo_nodes * albedo_nodes>;

/// The table of a distribution under a masking function.
[[nodiscard]] const AlbedoTable& albedo_table(const MicrofacetOptions& options);

/// All tables in the order of their index: Beckmann with rational masking, with exact masking, GGX.
[[nodiscard]] const std::array<AlbedoTable, 3>& albedo_tables();

}  // namespace facet::bsdf
