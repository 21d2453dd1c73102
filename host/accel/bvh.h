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

/// What is known of a hierarchy beside its items.
struct BvhFacts {
  UnfilledVector<std::uint32_t> places;  ///< of each triangle of the input: 2 * item + half
  std::vector<CopiedLeaf> copies;        ///< where triangles are in several leaves
  std::size_t node_count = 0;
  std::uint32_t stack_size = 0;  ///< levels of nodes: entries that a traversal needs at most
  Box bounds;
  double sah_cost = 0;  ///< expected visits of nodes and leaves by a random ray that hits the
                        ///< root's box
};

struct Bvh : BvhFacts {
  UnfilledVector<shared::BvhItem> items;
  UnfilledVector<shared::PairRecord> pairs;  ///< of each item; names hold the input's indices,
                                             ///< meshes are 0
};

/// An item as a node.
[[nodiscard]] inline shared::BvhNode node_of(const shared::BvhItem& item) {
  return std::bit_cast<shared::BvhNode>(item);
}
/// The triangle at a place of items and pairs, its corners in the input's order.
[[nodiscard]] TriangleCorners triangle_at(std::uint32_t place,
                                          std::span<const shared::BvhItem> items,
                                          std::span<const shared::PairRecord> pairs);

/// Builds the hierarchy; deterministic, whatever the number of threads. Empty input gives a root
/// without children.
[[nodiscard]] Bvh build_bvh(std::span<const TriangleCorners> triangles);

}  // namespace facet
