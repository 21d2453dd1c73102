#pragma once
// The reference's own acceleration structure: a binary tree of boxes, depth first.
#include <cstdint>
#include <span>
#include <vector>

#include "core/maths.h"

namespace facet::reference {

/// A leaf where count > 0. The left child of an inner node is the next node.
struct TreeNode {
  Box box;
  std::uint32_t first_or_right = 0;  ///< first primitive of a leaf, right child of an inner node
  std::uint32_t count = 0;
};

struct Tree {
  std::vector<TreeNode> nodes;       ///< empty for no primitives
  std::vector<std::uint32_t> order;  ///< primitives in the order of the leaves
};

/// Nodes on a path from the root at most, hence the size of a traversal's stack.
inline constexpr std::size_t tree_depth_limit = 96;

/// Splits by the surface-area heuristic over all positions of primitives sorted along the longest
/// axis (J. Goldsmith, J. Salmon 1987; sweep after I. Wald, V. Havran 2006); boxes are those of the
/// primitives.
[[nodiscard]] Tree build_tree(std::span<const Box> boxes);

}  // namespace facet::reference
