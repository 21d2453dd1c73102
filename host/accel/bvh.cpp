#include "accel/bvh.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "accel/binary_bvh.h"
#include "core/error.h"
#include "core/parallel.h"

namespace facet {

namespace {

constexpr std::uint32_t width = 4;

/// Smallest biased exponent e whose 255 steps of 2^(e-127) cover the extent.
std::uint32_t step_exponent(float extent) {
  int e = 0;
  // extent/255 = m * 2^e with m < 1, so 2^e steps suffice.
  (void)std::frexp(static_cast<double>(extent) / 255.0, &e);
  if (extent <= 0) e = -126;
  return static_cast<std::uint32_t>(std::clamp(e + 127, 1, 254));
}

/// Collapses the binary hierarchy into nodes of four children with quantised boxes.
class Collapser {
 public:
  Collapser(const std::vector<BinaryNode>& binary, std::vector<shared::BvhNode>& nodes)
      : binary_(binary), nodes_(nodes) {}

  /// Node for binary node `root`, appended with its descendants; returns the number of levels.
  std::uint32_t collapse(std::uint32_t root) {
    const auto at = nodes_.size();
    nodes_.emplace_back();
    std::array<std::uint32_t, width> children{};
    const std::uint32_t count = gather_children(root, children);
    nodes_[at] = quantise(binary_[root].box, children, count);
    visit_cost_ += binary_[root].box.half_area();
    std::uint32_t deepest = 0;
    for (std::uint32_t c = 0; c < count; ++c) {
      const BinaryNode& child = binary_[children[c]];
      if (child.count > 0) {
        nodes_[at].children[static_cast<int>(c)] =
            shared::REFERENCE_LEAF | (child.count << shared::REFERENCE_COUNT_SHIFT) | child.first;
        visit_cost_ += static_cast<double>(child.box.half_area()) * child.count;
      } else {
        nodes_[at].children[static_cast<int>(c)] = static_cast<std::uint32_t>(nodes_.size());
        deepest = std::max(deepest, collapse(children[c]));
      }
    }
    return 1 + deepest;
  }

  /// Sum over nodes of half area, and over leaves of half area times triangles.
  [[nodiscard]] double visit_cost() const { return visit_cost_; }

 private:
  /// Opens the child of largest area until there are four or only leaves.
  std::uint32_t gather_children(std::uint32_t root, std::array<std::uint32_t, width>& children) const {
    if (binary_[root].count > 0) {
      children[0] = root;
      return 1;
    }
    children[0] = binary_[root].left;
    children[1] = binary_[root].right;
    std::uint32_t count = 2;
    while (count < width) {
      std::uint32_t largest = width;
      float area = -1;
      for (std::uint32_t c = 0; c < count; ++c) {
        const BinaryNode& child = binary_[children[c]];
        if (child.count > 0 || child.box.half_area() <= area) continue;
        area = child.box.half_area();
        largest = c;
      }
      if (largest == width) break;
      const BinaryNode& opened = binary_[children[largest]];
      children[largest] = opened.left;
      children[count++] = opened.right;
    }
    return count;
  }

  [[nodiscard]] shared::BvhNode quantise(const Box& box, const std::array<std::uint32_t, width>& children,
                                         std::uint32_t count) const {
    shared::BvhNode node{};
    std::array<glm::uint, 3> lower{};
    std::array<glm::uint, 3> upper{};
    for (int a = 0; a < 3; ++a) {
      const std::uint32_t exponent = step_exponent(box.extent()[a]);
      const double step = std::ldexp(1.0, static_cast<int>(exponent) - 127);
      node.origin_exponents[a] = std::bit_cast<std::uint32_t>(box.lower[a]);
      node.origin_exponents.w |= exponent << (8U * static_cast<unsigned>(a));
      for (std::uint32_t c = 0; c < width; ++c) {
        // A missing child is an inside-out box.
        std::uint32_t lo = 255;
        std::uint32_t hi = 0;
        if (c < count) {
          const Box& child = binary_[children[c]].box;
          const double origin = box.lower[a];
          lo = static_cast<std::uint32_t>(
              std::clamp(std::floor((child.lower[a] - origin) / step), 0.0, 255.0));
          hi =
              static_cast<std::uint32_t>(std::clamp(std::ceil((child.upper[a] - origin) / step), 0.0, 255.0));
        }
        lower[static_cast<std::size_t>(a)] |= lo << (8 * c);
        upper[static_cast<std::size_t>(a)] |= hi << (8 * c);
      }
    }
    node.children = glm::uvec4(shared::REFERENCE_LEAF);
    node.lower = {lower[0], lower[1], lower[2], upper[0]};
    node.upper = {upper[1], upper[2], 0, 0};
    return node;
  }

  const std::vector<BinaryNode>& binary_;
  std::vector<shared::BvhNode>& nodes_;
  double visit_cost_ = 0;
};

std::vector<BvhPrimitive> make_primitives(std::span<const TriangleCorners> triangles) {
  std::vector<BvhPrimitive> primitives(triangles.size());
  parallel_for(triangles.size(), 1U << 14U, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (const vec3& corner : triangles[i]) primitives[i].box.add(corner);
      primitives[i].index = static_cast<std::uint32_t>(i);
    }
  });
  return primitives;
}

}  // namespace

Bvh build_bvh(std::span<const TriangleCorners> triangles) {
  if (triangles.size() > largest_triangle_count) {
    throw InputError(fmt::format("the scene has {} triangles; at most {} are supported", triangles.size(),
                                 largest_triangle_count));
  }
  Bvh bvh;
  if (triangles.empty()) {
    // A root whose four children are empty boxes at the origin.
    shared::BvhNode root{};
    root.origin_exponents.w = 0x010101;
    root.children = glm::uvec4(shared::REFERENCE_LEAF);
    root.lower = {0xffffffffU, 0xffffffffU, 0xffffffffU, 0};
    bvh.nodes.push_back(root);
    bvh.stack_size = 1;
    return bvh;
  }
  std::vector<BvhPrimitive> primitives = make_primitives(triangles);
  const std::vector<BinaryNode> binary = build_binary_bvh(primitives);
  bvh.bounds = binary.front().box;
  bvh.nodes.reserve(binary.size() / 2);
  Collapser collapser(binary, bvh.nodes);
  bvh.stack_size = collapser.collapse(0);
  if (bvh.nodes.size() > shared::LARGEST_NODE_COUNT) {
    throw InputError(fmt::format("the BVH has {} nodes; at most {} are supported", bvh.nodes.size(),
                                 shared::LARGEST_NODE_COUNT));
  }
  bvh.nodes.shrink_to_fit();
  bvh.sah_cost = collapser.visit_cost() / std::max(1e-30, static_cast<double>(bvh.bounds.half_area()));
  bvh.order.resize(primitives.size());
  std::transform(primitives.begin(), primitives.end(), bvh.order.begin(),
                 [](const BvhPrimitive& p) { return p.index; });
  return bvh;
}

}  // namespace facet
