#include "accel/bvh.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "accel/binary_bvh.h"
#include "accel/wide_tree.h"
#include "core/error.h"
#include "core/parallel.h"

namespace facet {

namespace {

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

/// Bits of a name that say which corners a triangle's vertices are; corner k is vertex vertices[k], none if
/// negative.
std::uint32_t name_bits(const std::array<int, 4>& vertices) {
  std::uint32_t bits = 0;
  for (std::uint32_t k = 0; k < 4; ++k) {
    if (vertices[k] >= 0) bits |= k << (2 * vertices[k]);
  }
  return bits << shared::NAME_INDEX_BITS;
}

/// What item 0 holds.
constexpr std::array<vec3, 4> no_triangle{vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 1, 0)};

/// Collapses the binary hierarchy into nodes of four children with quantised boxes.
class Collapser {
 public:
  Collapser(const std::vector<BinaryNode>& binary, std::span<const TrianglePair> pairs,
            std::span<const TriangleCorners> triangles, Bvh& bvh)
      : binary_(binary), wide_(binary), pairs_(pairs), triangles_(triangles), bvh_(bvh) {}

  void collapse() {
    bvh_.places.resize(triangles_.size());
    const std::size_t start = add_block();
    set_item(bvh_.items[start], no_triangle);
    bvh_.stack_size = collapse(0, start + shared::ROOT_ITEM);
    bvh_.items.shrink_to_fit();
    bvh_.pairs.shrink_to_fit();
    bvh_.sah_cost = visit_cost_ / std::max(1e-30, static_cast<double>(binary_.front().box.half_area()));
  }

 private:
  /// Makes the item a node for binary node `root`, and appends its descendants; returns the number of levels.
  std::uint32_t collapse(std::uint32_t root, std::size_t item) {
    Children children = wide_.children_of(root);
    const auto is_inner = [&](std::uint32_t child) { return !binary_[child].is_leaf(); };
    const auto leaves =
        std::stable_partition(children.nodes.begin(), children.nodes.begin() + children.count, is_inner);
    const auto inner_count = static_cast<std::uint32_t>(leaves - children.nodes.begin());
    const std::size_t first = add_block();
    shared::BvhNode node = quantise(binary_[root].box, children);
    node.lower_header.w =
        static_cast<std::uint32_t>(first / shared::BLOCK_SIZE) << shared::HEADER_INNER_BITS | inner_count;
    set_item(bvh_.items[item], node);
    ++bvh_.node_count;
    visit_cost_ += binary_[root].box.half_area();
    std::uint32_t deepest = 0;
    for (std::uint32_t c = 0; c < inner_count; ++c)
      deepest = std::max(deepest, collapse(children.nodes[c], first + c));
    for (std::uint32_t c = inner_count; c < children.count; ++c)
      place_leaf(binary_[children.nodes[c]], first + c);
    return 1 + deepest;
  }

  /// Returns the first of its items.
  std::size_t add_block() {
    bvh_.items.resize(bvh_.items.size() + shared::BLOCK_SIZE);
    bvh_.pairs.resize(bvh_.items.size());
    return bvh_.items.size() - shared::BLOCK_SIZE;
  }

  /// Makes the item the leaf's pair of triangles, or its only one.
  void place_leaf(const BinaryNode& leaf, std::size_t item) {
    visit_cost_ += leaf.box.half_area();
    const TrianglePair& pair = pairs_[leaf.primitive];
    const TriangleCorners& p = triangles_[pair.first];
    const std::array<int, 3> turned{pair.turn, (pair.turn + 1) % 3, (pair.turn + 2) % 3};
    std::array<vec3, 4> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = p[static_cast<std::size_t>(turned[k])];
    corners[3] = corners[2];
    shared::PairRecord& names = bvh_.pairs[item];
    names.name0 = pair.first | name_bits({turned[0], turned[1], turned[2], -1});
    bvh_.places[pair.first] = static_cast<std::uint32_t>(2 * item);
    if (pair.second != none) {
      const TriangleCorners& q = triangles_[pair.second];
      const int after = (pair.apex + 1) % 3;
      const int before = (pair.apex + 2) % 3;
      corners[3] = q[pair.apex];
      // Which end of the common edge is which depends on how the two are wound.
      const bool is_after = q[static_cast<std::size_t>(after)] == corners[0];
      names.name1 =
          pair.second | name_bits({is_after ? after : before, -1, is_after ? before : after, pair.apex});
      bvh_.places[pair.second] = static_cast<std::uint32_t>(2 * item + 1);
    }
    set_item(bvh_.items[item], corners);
  }

  [[nodiscard]] shared::BvhNode quantise(const Box& box, const Children& children) const {
    shared::BvhNode node{};
    for (int a = 0; a < 3; ++a) {
      const std::uint32_t exponent = step_exponent(box.extent()[a]);
      const double step = std::ldexp(1.0, static_cast<int>(exponent) - 127);
      node.origin_exponents[a] = std::bit_cast<std::uint32_t>(box.lower[a]);
      node.origin_exponents.w |= exponent << (8U * static_cast<unsigned>(a));
      for (std::uint32_t c = 0; c < shared::BLOCK_SIZE; ++c) {
        // A missing child is an inside-out box.
        std::uint32_t lo = 255;
        std::uint32_t hi = 0;
        if (c < children.count) {
          const Box& child = binary_[children.nodes[c]].box;
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
  WideTree wide_;
  std::span<const TrianglePair> pairs_;
  std::span<const TriangleCorners> triangles_;
  Bvh& bvh_;
  double visit_cost_ = 0;  ///< sum of the half areas of nodes and leaves
};

std::vector<BvhPrimitive> make_primitives(std::span<const TrianglePair> pairs,
                                          std::span<const TriangleCorners> triangles) {
  std::vector<BvhPrimitive> primitives(pairs.size());
  parallel_for(pairs.size(), 1U << 14U, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Box box = bounds_of(triangles[pairs[i].first]);
      if (pairs[i].second != none) box.add(bounds_of(triangles[pairs[i].second]));
      primitives[i] = {box, static_cast<std::uint32_t>(i)};
    }
  });
  return primitives;
}

}  // namespace

std::array<vec3, 4> Bvh::corners(std::size_t item) const {
  return std::bit_cast<std::array<vec3, 4>>(items[item]);
}

TriangleCorners Bvh::triangle(std::uint32_t place) const {
  const std::array<vec3, 4> c = corners(place / 2);
  const std::uint32_t name = place % 2 == 0 ? pairs[place / 2].name0 : pairs[place / 2].name1;
  const std::uint32_t vertices = name >> shared::NAME_INDEX_BITS;
  return {c[vertices & 3U], c[vertices >> 2U & 3U], c[vertices >> 4U]};
}

Bvh build_bvh(std::span<const TriangleCorners> triangles) {
  if (triangles.size() > shared::NAME_INDEX_MASK) {
    throw InputError(fmt::format("the scene has {} triangles; at most {} are supported", triangles.size(),
                                 shared::NAME_INDEX_MASK));
  }
  Bvh bvh;
  if (triangles.empty()) {
    // A root whose four children are empty boxes at the origin.
    shared::BvhNode root{};
    root.origin_exponents.w = 0x010101;
    root.lower_header = {0xffffffffU, 0xffffffffU, 0xffffffffU, 0};
    bvh.items.resize(shared::BLOCK_SIZE);
    bvh.pairs.resize(shared::BLOCK_SIZE);
    set_item(bvh.items.front(), no_triangle);
    set_item(bvh.items[shared::ROOT_ITEM], root);
    bvh.node_count = 1;
    bvh.stack_size = 1;
    return bvh;
  }
  const std::vector<TrianglePair> pairs = pair_triangles(triangles);
  std::vector<BvhPrimitive> primitives = make_primitives(pairs, triangles);
  const std::vector<BinaryNode> binary = build_binary_bvh(primitives);
  bvh.bounds = binary.front().box;
  Collapser(binary, pairs, triangles, bvh).collapse();
  if (bvh.items.size() > std::size_t{shared::LARGEST_BLOCK_COUNT} * shared::BLOCK_SIZE) {
    throw InputError(fmt::format("the BVH of {} triangles has {} nodes; at most {} are supported",
                                 triangles.size(), bvh.node_count, shared::LARGEST_BLOCK_COUNT));
  }
  return bvh;
}

}  // namespace facet
