#include "accel/bvh.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "accel/binary_bvh.h"
#include "core/error.h"
#include "core/parallel.h"

namespace facet {

namespace {

constexpr std::uint32_t width = shared::BLOCK_SIZE;
using Children = std::array<std::uint32_t, width>;  ///< binary nodes

/// Smallest biased exponent e whose 255 steps of 2^(e-127) cover the extent.
std::uint32_t step_exponent(float extent) {
  int e = 0;
  // extent/255 = m * 2^e with m < 1, so 2^e steps suffice.
  (void)std::frexp(static_cast<double>(extent) / 255.0, &e);
  if (extent <= 0) e = -126;
  return static_cast<std::uint32_t>(std::clamp(e + 127, 1, 254));
}

template <typename Record>
void set_item(shared::BvhItem& item, const Record& record) {
  item = std::bit_cast<shared::BvhItem>(record);
}

glm::uvec4 texel_of(const vec3& position, std::uint32_t w) { return {glm::floatBitsToUint(position), w}; }

/// Collapses the binary hierarchy into nodes of four children with quantised boxes.
class Collapser {
 public:
  Collapser(const std::vector<BinaryNode>& binary, std::span<const BvhPrimitive> primitives,
            std::span<const TriangleCorners> triangles, Bvh& bvh)
      : binary_(binary), primitives_(primitives), triangles_(triangles), bvh_(bvh) {}

  void collapse() {
    bvh_.places.resize(triangles_.size());
    const std::size_t root = add_block();
    overflow_ = {root + 1, root + shared::BLOCK_SIZE};
    bvh_.stack_size = collapse(0, root);
    bvh_.items.shrink_to_fit();
    bvh_.sah_cost = visit_cost_ / std::max(1e-30, static_cast<double>(binary_.front().box.half_area()));
  }

 private:
  /// Makes the item a node for binary node `root`, and appends its descendants; returns the number of levels.
  std::uint32_t collapse(std::uint32_t root, std::size_t item) {
    Children children{};
    const std::uint32_t count = gather_children(root, children);
    const auto is_inner = [&](std::uint32_t child) { return binary_[child].count == 0; };
    const auto leaves = std::stable_partition(children.begin(), children.begin() + count, is_inner);
    const auto inner_count = static_cast<std::uint32_t>(leaves - children.begin());
    const std::size_t first = add_block();
    shared::BvhNode node = quantise(binary_[root].box, children, count);
    node.lower_header.w =
        static_cast<std::uint32_t>(first / shared::BLOCK_SIZE) << shared::HEADER_INNER_BITS | inner_count;
    set_item(bvh_.items[item], node);
    ++bvh_.node_count;
    visit_cost_ += binary_[root].box.half_area();
    std::uint32_t deepest = 0;
    for (std::uint32_t c = 0; c < inner_count; ++c)
      deepest = std::max(deepest, collapse(children[c], first + c));
    Range spare{first + count, first + shared::BLOCK_SIZE};
    for (std::uint32_t c = inner_count; c < count; ++c) place_leaf(binary_[children[c]], first + c, spare);
    return 1 + deepest;
  }

  struct Range {
    std::size_t begin;
    std::size_t end;
  };

  /// Returns the first of its items.
  std::size_t add_block() {
    bvh_.items.resize(bvh_.items.size() + shared::BLOCK_SIZE);
    return bvh_.items.size() - shared::BLOCK_SIZE;
  }

  /// An item for a triangle that is not its leaf's first: one that its block has to spare, or else one of a
  /// block of such.
  std::size_t further_item(Range& spare) {
    if (spare.begin < spare.end) return spare.begin++;
    if (overflow_.begin == overflow_.end) {
      const std::size_t block = add_block();
      overflow_ = {block, block + shared::BLOCK_SIZE};
    }
    return overflow_.begin++;
  }

  /// Lays the leaf's triangles down, the first as this item.
  void place_leaf(const BinaryNode& leaf, std::size_t item, Range& spare) {
    visit_cost_ += static_cast<double>(leaf.box.half_area()) * leaf.count;
    for (std::uint32_t k = 0; k < leaf.count; ++k) {
      const std::uint32_t index = primitives_[leaf.first + k].index;
      const TriangleCorners& corners = triangles_[index];
      const std::size_t next = k + 1 < leaf.count ? further_item(spare) : 0;
      set_item(bvh_.items[item],
               shared::TriangleRecord{texel_of(corners[0], 0), texel_of(corners[1], 0),
                                      texel_of(corners[2], static_cast<std::uint32_t>(next))});
      bvh_.places[index] = static_cast<std::uint32_t>(item);
      item = next;
    }
  }

  /// Opens the child of largest area until there are four or only leaves.
  std::uint32_t gather_children(std::uint32_t root, Children& children) const {
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

  [[nodiscard]] shared::BvhNode quantise(const Box& box, const Children& children,
                                         std::uint32_t count) const {
    shared::BvhNode node{};
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
        node.lower_header[a] |= lo << (8 * c);
        node.upper[a] |= hi << (8 * c);
      }
    }
    return node;
  }

  const std::vector<BinaryNode>& binary_;
  std::span<const BvhPrimitive> primitives_;
  std::span<const TriangleCorners> triangles_;
  Bvh& bvh_;
  Range overflow_{};       ///< free items of the block that takes triangles for which their own has no room
  double visit_cost_ = 0;  ///< sum over nodes of half area, and over leaves of half area times triangles
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
  constexpr std::size_t most_items = std::size_t{shared::LARGEST_BLOCK_COUNT} * shared::BLOCK_SIZE;
  if (triangles.size() >= most_items) {
    throw InputError(
        fmt::format("the scene has {} triangles; fewer than {} are supported", triangles.size(), most_items));
  }
  Bvh bvh;
  if (triangles.empty()) {
    // A root whose four children are empty boxes at the origin.
    shared::BvhNode root{};
    root.origin_exponents.w = 0x010101;
    root.lower_header = {0xffffffffU, 0xffffffffU, 0xffffffffU, 0};
    set_item(bvh.items.emplace_back(), root);
    bvh.node_count = 1;
    bvh.stack_size = 1;
    return bvh;
  }
  std::vector<BvhPrimitive> primitives = make_primitives(triangles);
  const std::vector<BinaryNode> binary = build_binary_bvh(primitives);
  bvh.bounds = binary.front().box;
  Collapser(binary, primitives, triangles, bvh).collapse();
  if (bvh.items.size() > most_items) {
    throw InputError(fmt::format("the BVH of {} triangles has {} nodes; at most {} are supported",
                                 triangles.size(), bvh.node_count, shared::LARGEST_BLOCK_COUNT));
  }
  return bvh;
}

}  // namespace facet
