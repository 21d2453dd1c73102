#pragma once
// Which nodes of a binary hierarchy become the nodes of one of four children a node.
#include <array>
#include <cstdint>
#include <vector>

#include "accel/binary_bvh.h"
#include "shared/records.h"

namespace facet {

/// Up to four binary nodes.
struct Children {
  std::array<BinaryBvh::Node, shared::BLOCK_SIZE> nodes{};
  std::uint32_t count = 0;

  void add(BinaryBvh::Node node) { nodes[count++] = node; }
};

/// Chooses them such that the sum of the half areas of the wide nodes, to which the number of those
/// that a random ray visits is proportional, is the smallest that this binary hierarchy allows (R.
/// Pinto, "Adaptive Collapsing on Bounding Volume Hierarchies for Ray-Tracing", Eurographics 2010).
class WideTree {
 public:
  explicit WideTree(const BinaryBvh& binary);

  /// Of the wide node that has this binary node's box; of a leaf, the leaf itself.
  [[nodiscard]] Children children_of(BinaryBvh::Node node) const;
  /// Wide nodes in a binary node's subtree; 0 of a leaf.
  [[nodiscard]] std::uint32_t node_count(BinaryBvh::Node node) const {
    return BinaryBvh::is_leaf(node) ? 0 : plans_[node].node_count;
  }

 private:
  static constexpr std::size_t most = shared::BLOCK_SIZE;

  /// Of the wide nodes in a subtree.
  struct Cost {
    float area = 0;  ///< sum of their half areas
    std::uint32_t nodes = 0;
  };
  /// A subtree as at most n children of one wide node, n being the index plus one.
  using Costs = std::array<Cost, most - 1>;

  struct Plan {
    /// How many of at most n children, n being the index plus one, the first half gets; 0: as with
    /// one fewer. Of four, of the node's own.
    std::array<std::uint8_t, most> of_first{};
    std::uint32_t node_count = 0;
  };

  /// Plans the node and all below it, of which `end` is the next inner node after them.
  Costs plan(BinaryBvh::Node node, BinaryBvh::Node end);
  [[nodiscard]] Costs plan_node(BinaryBvh::Node node, const Costs& first, const Costs& second);
  void divide(BinaryBvh::Node node, std::size_t n, Children& children) const;

  const BinaryBvh& binary_;
  std::vector<Plan> plans_;  ///< of the inner nodes
};

}  // namespace facet
