#pragma once
// The boxes over which the hierarchy is built: one for each pair of triangles, or several where
// that keeps rays from meeting very many of them.
#include <span>
#include <vector>

#include "accel/binary_bvh.h"
#include "accel/triangle_pairs.h"
#include "core/unfilled_vector.h"

namespace facet {

struct LeafBoxes {
  /// The first of each pair has the pair's index, further ones follow with indices from pair_count
  /// on.
  UnfilledVector<BvhPrimitive> primitives;
  std::size_t pair_count = 0;
  std::vector<std::uint32_t>
      copies;  ///< the pair of each further one, in the order of their indices

  /// The pair of a primitive's index.
  [[nodiscard]] std::uint32_t pair_of(std::uint32_t index) const {
    return index < pair_count ? index : copies[index - pair_count];
  }
};

/// One box for each pair.
[[nodiscard]] LeafBoxes make_leaf_boxes(std::span<const TrianglePair> pairs,
                                        std::span<const TriangleCorners> triangles);

/// Of the leaves below a node of the hierarchy, those that a random ray through its box meets: the
/// sum of their half areas over its own. Nodes of more than this are crowded.
inline constexpr double most_met_leaves = 512;

/// Divides boxes in crowded nodes of the hierarchy built over one for each pair: at planes that
/// halve the node, again and again, into boxes of the pairs' parts to either side. A fan of long
/// triangles, for example, whose boxes all hold the place where they meet and much around it, then
/// has boxes that follow them. Stops where a division helps little, and at some dozens of boxes for
/// each pair there. Returns no copies where there is nothing to divide. Deterministic. The field
/// calls this splitting references beforehand, or early split clipping: M. Ernst, G. Greiner,
/// "Early Split Clipping for Bounding Volume Hierarchies", RT 2007.
[[nodiscard]] LeafBoxes divide_crowded(const BinaryBvh& binary, std::span<const TrianglePair> pairs,
                                       std::span<const TriangleCorners> triangles,
                                       std::size_t most_copies);

}  // namespace facet
