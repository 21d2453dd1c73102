#pragma once
// The binary hierarchy from which the four-wide one is collapsed.
#include <cstdint>
#include <span>
#include <vector>

#include "core/maths.h"

namespace facet {

/// What the builder sorts: the box of one or two triangles, and an index.
struct BvhPrimitive {
  Box box;
  std::uint32_t index = 0;

  /// Twice the box's centre, which sorts alike.
  [[nodiscard]] vec3 centre2() const { return box.lower + box.upper; }
};

/// A node's first child is the next node; a subtree of n primitives takes 2n - 1 nodes.
struct BinaryNode {
  Box box;
  std::uint32_t second = 0;     ///< index of the second child; 0 in a leaf
  std::uint32_t primitive = 0;  ///< leaf: BvhPrimitive::index

  [[nodiscard]] bool is_leaf() const { return second == 0; }
};

/// The nodes, the root first; every leaf holds one primitive. Sorts the primitives, of which there is at
/// least one. Binned surface area heuristic: I. Wald, "On fast Construction of SAH-based Bounding Volume
/// Hierarchies", RT 2007.
[[nodiscard]] std::vector<BinaryNode> build_binary_bvh(std::span<BvhPrimitive> primitives);

}  // namespace facet
