#pragma once
// The acceleration structure that the kernels traverse: a bounding volume hierarchy of four children a node
// with quantised boxes, built over triangles by the surface area heuristic on all cores.
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/maths.h"
#include "shared/records.h"

namespace facet {

/// A triangle's corners, world space.
using TriangleCorners = std::array<vec3, 3>;

struct Bvh {
  std::vector<shared::BvhItem> items;  ///< the first is the root; triangles lack mesh and index
  std::vector<std::uint32_t> places;   ///< item of each triangle of the input
  std::size_t node_count = 0;
  std::uint32_t stack_size = 0;  ///< levels of nodes: entries that a traversal needs at most
  Box bounds;
  double sah_cost = 0;  ///< expected node visits plus triangle tests of a random ray that hits the root's box

  [[nodiscard]] shared::BvhNode node(std::size_t item) const {
    return std::bit_cast<shared::BvhNode>(items[item]);
  }
  [[nodiscard]] shared::TriangleRecord triangle(std::size_t item) const {
    return std::bit_cast<shared::TriangleRecord>(items[item]);
  }
};

/// Builds the hierarchy; deterministic, whatever the number of threads. Empty input gives a root without
/// children.
[[nodiscard]] Bvh build_bvh(std::span<const TriangleCorners> triangles);

}  // namespace facet
