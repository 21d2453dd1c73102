#pragma once
// Triangles joined in twos along a common edge, which the acceleration structure holds as one.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/maths.h"

namespace facet {

/// A triangle's corners, world space.
using TriangleCorners = std::array<vec3, 3>;

inline Box bounds_of(const TriangleCorners& triangle) {
  Box box;
  for (const vec3& corner : triangle) box.add(corner);
  return box;
}

/// One or two triangles. With p the vertices of the first and q of the second, corners 0, 1, 2 of
/// the pair are p[turn], p[turn + 1], p[turn + 2] (modulo 3), and corner 3 is q[apex]; the common
/// edge is that of corners 2 and 0.
struct TrianglePair {
  std::uint32_t first = 0;
  std::uint32_t second = none;  ///< none: there is one triangle only
  std::uint8_t turn = 0;
  std::uint8_t apex = 0;
};

/// Joins the triangles: each is in exactly one pair, and the box of two is no larger than their
/// boxes together. Deterministic, whatever the number of threads.
[[nodiscard]] std::vector<TrianglePair> pair_triangles(std::span<const TriangleCorners> triangles);

}  // namespace facet
