#pragma once
// The binary hierarchy from which the four-wide one is collapsed.
#include <bit>
#include <cstdint>
#include <span>

#include "core/float4.h"
#include "core/unfilled_vector.h"

namespace facet {

/// What the builder sorts: the box of one or two triangles, and an index, which lies in the box's
/// idle lane.
class BvhPrimitive {
 public:
  BvhPrimitive() = default;
  /// Adding 0 leaves zeros of one sign alone, among which minima and maxima depend on no order.
  BvhPrimitive(const Box& box, std::uint32_t index)
      : box_{to_float4(box.lower) + Float4{}, to_float4(box.upper) + Float4{}} {
    box_.lower[3] = std::bit_cast<float>(index + bias);
  }

  [[nodiscard]] const Box4& box() const { return box_; }
  [[nodiscard]] std::uint32_t index() const {
    return std::bit_cast<std::uint32_t>(box_.lower[3]) - bias;
  }
  /// Twice the box's centre, which sorts alike.
  [[nodiscard]] Float4 centre2() const { return box_.lower + box_.upper; }

 private:
  /// Makes an index a normal float: arithmetic with denormal ones, which nobody wants here, is
  /// slow.
  static constexpr std::uint32_t bias = 1U << 28U;

  Box4 box_;
};

/// A hierarchy over primitives, one in each leaf.
class BinaryBvh {
 public:
  /// Names a node.
  using Node = std::uint32_t;

  /// Of at least one primitive. Binned surface area heuristic: I. Wald, "On fast Construction of
  /// SAH-based Bounding Volume Hierarchies", RT 2007. Deterministic, whatever the number of
  /// threads.
  explicit BinaryBvh(UnfilledVector<BvhPrimitive> primitives);

  [[nodiscard]] Node root() const { return inner_.empty() ? leaf : 0; }
  [[nodiscard]] static bool is_leaf(Node node) { return (node & leaf) != 0; }
  /// A leaf's primitive, as its index() tells.
  [[nodiscard]] std::uint32_t primitive(Node node) const {
    return primitives_[node & ~leaf].index();
  }
  [[nodiscard]] Box box(Node node) const {
    if (is_leaf(node)) return primitives_[node & ~leaf].box().box();
    return {inner_[node].lower, inner_[node].upper};
  }

  /// Number of nodes that are no leaves: their names are 0 to that, an inner node's before those
  /// below it, which follow it.
  [[nodiscard]] std::size_t inner_count() const { return inner_.size(); }
  /// Of an inner node.
  [[nodiscard]] Node first(Node node) const { return inner_[node].first; }
  [[nodiscard]] Node second(Node node) const { return inner_[node].second; }

 private:
  friend class BinaryBuilder;
  static constexpr Node leaf = 0x80000000U;

  struct Inner {
    vec3 lower;
    vec3 upper;
    Node first;
    Node second;
  };

  UnfilledVector<BvhPrimitive> primitives_;  ///< in the order of leaves
  UnfilledVector<Inner> inner_;
};

}  // namespace facet
