#pragma once
// Which nodes of a binary hierarchy become the nodes of one of four children a node.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/binary_bvh.h"
#include "shared/records.h"

namespace facet {

/// Up to four binary nodes.
struct Children {
  std::array<std::uint32_t, shared::BLOCK_SIZE> nodes{};
  std::uint32_t count = 0;

  void add(std::uint32_t node) { nodes[count++] = node; }
};

/// Chooses them such that the sum of the half areas of the wide nodes, to which the number of those that a
/// random ray visits is proportional, is the smallest that this binary hierarchy allows (R. Pinto, "Adaptive
/// Collapsing on Bounding Volume Hierarchies for Ray-Tracing", Eurographics 2010).
class WideTree {
 public:
  explicit WideTree(std::span<const BinaryNode> binary);

  /// Of the wide node that has this binary node's box; of a leaf, the leaf itself.
  [[nodiscard]] Children children_of(std::uint32_t node) const;

 private:
  static constexpr std::size_t most = shared::BLOCK_SIZE;

  /// A subtree as at most n children of one wide node, n being the index plus one.
  struct Plan {
    std::array<float, most - 1> cost{};  ///< sum of half areas of wide nodes in the subtree
    std::array<std::uint8_t, most>
        of_first{};  ///< how many of the n the first half gets; 0: as with one fewer; of 4: its own
  };

  [[nodiscard]] Plan plan(std::uint32_t node) const;
  void divide(std::uint32_t node, std::size_t n, Children& children) const;

  std::span<const BinaryNode> binary_;
  std::vector<Plan> plans_;
};

}  // namespace facet
