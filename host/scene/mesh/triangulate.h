#pragma once
// Polygons in space as triangles.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/maths.h"

namespace facet {

/// A polygon's triangles, by the numbers of their corners, each wound as it is. Consecutive corners
/// at one place count once; of n that are left there are n - 2 triangles, none for fewer than
/// three. The polygon lies in a plane or nearly so, and may be concave; of one that crosses itself
/// the triangles are some. Takes n log n steps, but for polygons made to take more. G. H. Meisters,
/// "Polygons Have Ears", American Mathematical Monthly 82(6), 1975.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const vec3> polygon);

}  // namespace facet
