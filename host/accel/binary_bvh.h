#pragma once
// The binary hierarchy from which the four-wide one is collapsed.
#include <cstdint>
#include <span>
#include <vector>

#include "core/maths.h"

namespace facet {

/// Most triangles in a leaf.
inline constexpr std::uint32_t leaf_size = 4;

/// What the builder sorts: a triangle's box and its index.
struct BvhPrimitive {
  Box box;
  std::uint32_t index = 0;

  /// Twice the box's centre, which sorts alike.
  [[nodiscard]] vec3 centre2() const { return box.lower + box.upper; }
};

struct BinaryNode {
  Box box;
  std::uint32_t left = 0;   ///< index of the first child, unused in a leaf
  std::uint32_t right = 0;  ///< index of the second
  std::uint32_t first = 0;  ///< leaf: first primitive
  std::uint32_t count = 0;  ///< leaf: number of primitives; 0 for inner nodes
};

/// Sorts the primitives into leaf order and returns the nodes, the root first. At least one primitive.
/// Binned surface area heuristic: I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies",
/// RT 2007.
[[nodiscard]] std::vector<BinaryNode> build_binary_bvh(std::span<BvhPrimitive> primitives);

}  // namespace facet
