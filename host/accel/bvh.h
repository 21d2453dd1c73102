#pragma once
// The acceleration structure that the kernels traverse: a bounding volume hierarchy of four children a node
// with quantised boxes, built over triangles by the surface area heuristic on all cores.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/maths.h"
#include "shared/records.h"

namespace facet {

/// A triangle's corners, world space.
using TriangleCorners = std::array<vec3, 3>;

struct Bvh {
  std::vector<shared::BvhNode> nodes;  ///< the first is the root
  std::vector<std::uint32_t> order;    ///< triangle i of the leaves is order[i] of the input
  std::uint32_t stack_size = 0;        ///< levels of nodes: entries that a traversal needs at most
  Box bounds;
  double sah_cost = 0;  ///< expected node visits plus triangle tests of a random ray that hits the root's box
};

/// Most triangles that a leaf reference can address.
inline constexpr std::size_t largest_triangle_count = shared::REFERENCE_FIRST_MASK;

/// Builds the hierarchy; deterministic, whatever the number of threads. Empty input gives a root without
/// children.
[[nodiscard]] Bvh build_bvh(std::span<const TriangleCorners> triangles);

}  // namespace facet
