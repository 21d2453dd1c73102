#pragma once
// Points of a plane, asked for those within a triangle.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/maths.h"

namespace facet {

/// Twice the signed area of a triangle: positive where c is left of the line from a to b.
[[nodiscard]] inline double signed_area(const dvec2& a, const dvec2& b, const dvec2& c) {
  const dvec2 ab = b - a;
  const dvec2 ac = c - a;
  return ab.x * ac.y - ab.y * ac.x;
}

/// Some of a list's points in a balanced k-d tree (J. L. Bentley, "Multidimensional Binary Search
/// Trees Used for Associative Searching", 1975), from which they can be removed.
class PointTree {
 public:
  /// Refers to points, the whole list; `members` are indices into it.
  PointTree(std::span<const dvec2> points, std::vector<std::uint32_t> members);

  /// Does nothing for a point that is no member.
  void remove(std::uint32_t member);
  /// Whether the counterclockwise triangle holds a member, in it or on its sides; those at its
  /// corners' places do not count.
  [[nodiscard]] bool any_in_triangle(const std::array<dvec2, 3>& triangle) const;

 private:
  struct Node {
    dvec2 low;
    dvec2 high;
    std::uint32_t left = 0;  ///< members that were not removed
  };
  struct Range {
    std::size_t begin;
    std::size_t end;
  };

  void build(std::size_t node, Range range);
  [[nodiscard]] bool search(std::size_t node, Range range,
                            const std::array<dvec2, 3>& triangle) const;

  std::span<const dvec2> points_;
  std::vector<std::uint32_t> members_;  ///< in the order of the leaves
  std::vector<bool> removed_;           ///< of these
  std::vector<std::uint32_t> places_;   ///< of the points among the members; none
  std::size_t leaves_ = 1;  ///< a power of two; node 0 is the root, node i has 2 i + 1 and 2 i + 2
  std::vector<Node> nodes_;
};

}  // namespace facet
