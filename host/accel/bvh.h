#pragma once
// The acceleration structure that the kernels traverse: a bounding volume hierarchy of four
// children a node with quantised boxes, built over triangles by the surface area heuristic on all
// cores.
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/triangle_pairs.h"
#include "core/maths.h"
#include "core/unfilled_vector.h"
#include "shared/records.h"

namespace facet {

/// A leaf that holds the same triangles as another.
struct CopiedLeaf {
  std::uint32_t item = 0;
  std::uint32_t original = 0;  ///< the item of which `places` tells
};

struct Bvh {
  UnfilledVector<shared::BvhItem> items;
  UnfilledVector<shared::PairRecord>
      pairs;  ///< of each item; names hold the input's indices, meshes are 0
  UnfilledVector<std::uint32_t> places;  ///< of each triangle of the input: 2 * item + half
  std::vector<CopiedLeaf> copies;        ///< where triangles are in several leaves
  std::size_t node_count = 0;
  std::uint32_t stack_size = 0;  ///< levels of nodes: entries that a traversal needs at most
  Box bounds;
  double sah_cost =
      0;  ///< expected visits of nodes and of leaves by a random ray that hits the root's box

  [[nodiscard]] shared::BvhNode node(std::size_t item) const {
    return std::bit_cast<shared::BvhNode>(items[item]);
  }
  /// An item's corners 0 to 3, world space.
  [[nodiscard]] std::array<vec3, 4> corners(std::size_t item) const;
  /// The triangle at a place, its corners in the input's order.
  [[nodiscard]] TriangleCorners triangle(std::uint32_t place) const;
};

/// Builds the hierarchy; deterministic, whatever the number of threads. Empty input gives a root
/// without children.
[[nodiscard]] Bvh build_bvh(std::span<const TriangleCorners> triangles);

}  // namespace facet
