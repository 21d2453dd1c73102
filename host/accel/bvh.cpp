#include "accel/bvh.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "accel/binary_bvh.h"
#include "accel/leaf_boxes.h"
#include "accel/wide_tree.h"
#include "core/error.h"
#include "core/memory.h"
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

/// Whole steps that are no more, and no fewer, than so many; 0 to 255.
std::uint32_t steps_below(double steps) {
  return static_cast<std::uint32_t>(std::clamp(steps, 0.0, 255.0));
}
std::uint32_t steps_above(double steps) {
  const std::uint32_t below = steps_below(steps);
  return below < 255 && static_cast<double>(below) < steps ? below + 1 : below;
}

template <typename Record>
void set_item(shared::BvhItem& item, const Record& record) {
  item = std::bit_cast<shared::BvhItem>(record);
}

/// Bits of a name that say which corners a triangle's vertices are; corner k is vertex vertices[k],
/// none if negative.
std::uint32_t name_bits(const std::array<int, 4>& vertices) {
  std::uint32_t bits = 0;
  for (std::uint32_t k = 0; k < 4; ++k) {
    if (vertices[k] >= 0) bits |= k << (2 * vertices[k]);
  }
  return bits << shared::NAME_INDEX_BITS;
}

/// What item 0 holds.
constexpr std::array<vec3, 4> no_triangle{vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0),
                                          vec3(0, 1, 0)};

/// Further leaves that dividing boxes may make, each of which takes about 100 bytes with its share
/// of nodes.
constexpr std::size_t further_leaves = 1U << 22U;

/// Subtrees of fewer wide nodes are one task.
constexpr std::uint32_t parallel_wide_nodes = 1U << 13U;

/// Of wide nodes.
struct Subtree {
  std::uint32_t levels = 0;
  double visit_cost = 0;  ///< sum of the half areas of nodes and leaves
  double leaf_area = 0;   ///< sum of the half areas of leaves
  double crowding = 0;  ///< the most leaves that a random ray through one of the nodes' boxes meets
};

/// Collapses the binary hierarchy into nodes of four children with quantised boxes. A subtree's
/// blocks follow one another, and how many they are is known, so that its parts are made side by
/// side.
class Collapser {
 public:
  Collapser(const BinaryBvh& binary, const LeafBoxes& boxes, std::span<const TrianglePair> pairs,
            std::span<const TriangleCorners> triangles, Bvh& bvh)
      : binary_(binary),
        boxes_(boxes),
        wide_(binary),
        pairs_(pairs),
        triangles_(triangles),
        bvh_(bvh) {}

  /// The root is a node even if it has one leaf alone.
  [[nodiscard]] std::size_t node_count() const {
    return std::max(1U, wide_.node_count(binary_.root()));
  }

  /// Returns the whole.
  Subtree collapse() {
    bvh_.bounds = binary_.box(binary_.root());
    bvh_.node_count = node_count();
    bvh_.items.resize((bvh_.node_count + 1) * shared::BLOCK_SIZE);
    bvh_.pairs.resize(bvh_.items.size());
    bvh_.places.resize(triangles_.size());
    bvh_.copies.resize(boxes_.copies.size());
    clear_block(0);
    set_item(bvh_.items.front(), no_triangle);
    const Subtree whole = collapse(binary_.root(), shared::ROOT_ITEM, 1);
    bvh_.stack_size = whole.levels;
    bvh_.sah_cost =
        whole.visit_cost / std::max(1e-30, static_cast<double>(bvh_.bounds.half_area()));
    for (std::size_t i = 0; i < bvh_.copies.size(); ++i)
      bvh_.copies[i].original = bvh_.places[pairs_[boxes_.copies[i]].first] / 2;
    return whole;
  }

 private:
  /// Makes the item a node for binary node `root`, and its descendants in the blocks from `block`
  /// on.
  Subtree collapse(BinaryBvh::Node root, std::size_t item, std::uint32_t block) {
    const Box box = binary_.box(root);
    Children children = wide_.children_of(root);
    const auto is_inner = [](BinaryBvh::Node child) { return !BinaryBvh::is_leaf(child); };
    const auto leaves = std::stable_partition(children.nodes.begin(),
                                              children.nodes.begin() + children.count, is_inner);
    const auto inner_count = static_cast<std::uint32_t>(leaves - children.nodes.begin());
    shared::BvhNode node = quantise(box, children);
    node.lower_header.w = block << shared::HEADER_INNER_BITS | inner_count;
    set_item(bvh_.items[item], node);
    clear_block(block);
    const std::size_t first = std::size_t{block} * shared::BLOCK_SIZE;
    std::array<std::uint32_t, shared::BLOCK_SIZE> blocks{};
    std::uint32_t next_block = block + 1;
    for (std::uint32_t c = 0; c < inner_count; ++c) {
      blocks[c] = next_block;
      next_block += wide_.node_count(children.nodes[c]);
    }
    std::array<Subtree, shared::BLOCK_SIZE> below{};
    const auto collapse_child = [&](std::size_t c) {
      below[c] = collapse(children.nodes[c], first + c, blocks[c]);
    };
    if (next_block - block > parallel_wide_nodes) {
      parallel_for(inner_count, 1, [&](std::size_t c, std::size_t /*end*/) { collapse_child(c); });
    } else {
      for (std::uint32_t c = 0; c < inner_count; ++c) collapse_child(c);
    }
    Subtree result{0, box.half_area()};
    for (const Subtree& s : below) {
      result.levels = std::max(result.levels, s.levels);
      result.visit_cost += s.visit_cost;
      result.leaf_area += s.leaf_area;
      result.crowding = std::max(result.crowding, s.crowding);
    }
    ++result.levels;
    for (std::uint32_t c = inner_count; c < children.count; ++c) {
      place_leaf(binary_.primitive(children.nodes[c]), first + c);
      const double area = binary_.box(children.nodes[c]).half_area();
      result.visit_cost += area;
      result.leaf_area += area;
    }
    if (box.half_area() > 0)
      result.crowding = std::max(result.crowding, result.leaf_area / box.half_area());
    return result;
  }

  void clear_block(std::size_t block) {
    const auto first = static_cast<std::ptrdiff_t>(block * shared::BLOCK_SIZE);
    std::fill_n(bvh_.items.begin() + first, shared::BLOCK_SIZE, shared::BvhItem{});
    std::fill_n(bvh_.pairs.begin() + first, shared::BLOCK_SIZE, shared::PairRecord{});
  }

  /// Makes the item a leaf: a pair of triangles, or one alone. The place of the pair's first leaf
  /// is its own.
  void place_leaf(std::uint32_t primitive, std::size_t item) {
    const TrianglePair& pair = pairs_[boxes_.pair_of(primitive)];
    const bool is_copy = primitive >= boxes_.pair_count;
    if (is_copy) bvh_.copies[primitive - boxes_.pair_count].item = static_cast<std::uint32_t>(item);
    const TriangleCorners& p = triangles_[pair.first];
    const std::array<int, 3> turned{pair.turn, (pair.turn + 1) % 3, (pair.turn + 2) % 3};
    std::array<vec3, 4> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = p[static_cast<std::size_t>(turned[k])];
    corners[3] = corners[2];
    shared::PairRecord& names = bvh_.pairs[item];
    names.name0 = pair.first | name_bits({turned[0], turned[1], turned[2], -1});
    if (!is_copy) bvh_.places[pair.first] = static_cast<std::uint32_t>(2 * item);
    if (pair.second != none) {
      const TriangleCorners& q = triangles_[pair.second];
      const int after = (pair.apex + 1) % 3;
      const int before = (pair.apex + 2) % 3;
      corners[3] = q[pair.apex];
      // Which end of the common edge is which depends on how the two are wound.
      const bool is_after = q[static_cast<std::size_t>(after)] == corners[0];
      names.name1 = pair.second | name_bits({is_after ? after : before, -1,
                                             is_after ? before : after, pair.apex});
      if (!is_copy) bvh_.places[pair.second] = static_cast<std::uint32_t>(2 * item + 1);
    }
    set_item(bvh_.items[item], corners);
  }

  [[nodiscard]] shared::BvhNode quantise(const Box& box, const Children& children) const {
    shared::BvhNode node{};
    std::array<Box, shared::BLOCK_SIZE> boxes;
    for (std::uint32_t c = 0; c < children.count; ++c) boxes[c] = binary_.box(children.nodes[c]);
    for (int a = 0; a < 3; ++a) {
      const std::uint32_t exponent = step_exponent(box.extent()[a]);
      const double inverse_step = std::ldexp(1.0, 127 - static_cast<int>(exponent));
      const double origin = box.lower[a];
      node.origin_exponents[a] = std::bit_cast<std::uint32_t>(box.lower[a]);
      node.origin_exponents.w |= exponent << (8U * static_cast<unsigned>(a));
      for (std::uint32_t c = 0; c < shared::BLOCK_SIZE; ++c) {
        // A missing child is an inside-out box.
        std::uint32_t lo = 255;
        std::uint32_t hi = 0;
        if (c < children.count) {
          const Box& child = boxes[c];
          lo = steps_below((child.lower[a] - origin) * inverse_step);
          hi = steps_above((child.upper[a] - origin) * inverse_step);
        }
        node.lower_header[a] |= lo << (8 * c);
        node.upper[a] |= hi << (8 * c);
      }
    }
    return node;
  }

  const BinaryBvh& binary_;
  const LeafBoxes& boxes_;
  WideTree wide_;
  std::span<const TrianglePair> pairs_;
  std::span<const TriangleCorners> triangles_;
  Bvh& bvh_;
};

/// Refuses a hierarchy of at least so many nodes if they are too many.
void check_node_count(std::size_t nodes, std::size_t triangles) {
  if (nodes <= shared::LARGEST_BLOCK_COUNT - 1) return;
  throw InputError(
      fmt::format("the scene has {} triangles, too many: their BVH has at least {} nodes, and at "
                  "most {} are supported",
                  triangles, nodes, shared::LARGEST_BLOCK_COUNT - 1));
}

}  // namespace

TriangleCorners triangle_at(std::uint32_t place, std::span<const shared::BvhItem> items,
                            std::span<const shared::PairRecord> pairs) {
  const auto c = std::bit_cast<std::array<vec3, 4>>(items[place / 2]);
  const std::uint32_t name = place % 2 == 0 ? pairs[place / 2].name0 : pairs[place / 2].name1;
  const std::uint32_t vertices = name >> shared::NAME_INDEX_BITS;
  return {c[vertices & 3U], c[vertices >> 2U & 3U], c[vertices >> 4U]};
}

Bvh build_bvh(std::span<const TriangleCorners> triangles) {
  const Activity activity(
      fmt::format("building the acceleration structure of {} triangles", triangles.size()));
  if (triangles.size() > shared::NAME_INDEX_MASK) {
    throw InputError(fmt::format("the scene has {} triangles; at most {} are supported",
                                 triangles.size(), shared::NAME_INDEX_MASK));
  }
  Bvh bvh;
  if (triangles.empty()) {
    // A root whose four children are empty boxes at the origin.
    shared::BvhNode root{};
    root.origin_exponents.w = 0x010101;
    root.lower_header = {0xffffffffU, 0xffffffffU, 0xffffffffU, 0};
    bvh.items.resize(shared::BLOCK_SIZE, shared::BvhItem{});
    bvh.pairs.resize(shared::BLOCK_SIZE, shared::PairRecord{});
    set_item(bvh.items.front(), no_triangle);
    set_item(bvh.items[shared::ROOT_ITEM], root);
    bvh.node_count = 1;
    bvh.stack_size = 1;
    return bvh;
  }
  const std::vector<TrianglePair> pairs = pair_triangles(triangles);
  // Every node but the root takes the place of one child, and makes room for at most so many.
  check_node_count((pairs.size() + shared::BLOCK_SIZE - 3) / (shared::BLOCK_SIZE - 1),
                   triangles.size());
  LeafBoxes boxes = make_leaf_boxes(pairs, triangles);
  const BinaryBvh binary(std::move(boxes.primitives));
  Collapser collapser(binary, boxes, pairs, triangles, bvh);
  check_node_count(collapser.node_count(), triangles.size());
  if (collapser.collapse().crowding <= most_met_leaves) return bvh;
  // A tenth less than there is room for, if nodes have as many leaves as now.
  const double room = 0.9 * static_cast<double>(pairs.size()) * (shared::LARGEST_BLOCK_COUNT - 1) /
                          static_cast<double>(bvh.node_count) -
                      static_cast<double>(pairs.size());
  if (room < 1) return bvh;
  boxes = divide_crowded(binary, pairs, triangles,
                         std::min(further_leaves, static_cast<std::size_t>(room)));
  if (boxes.copies.empty()) return bvh;
  const BinaryBvh divided(std::move(boxes.primitives));
  Bvh second;
  Collapser second_collapser(divided, boxes, pairs, triangles, second);
  if (second_collapser.node_count() >= shared::LARGEST_BLOCK_COUNT) return bvh;
  second_collapser.collapse();
  // Its boxes have margins; the bounds are those of the triangles.
  second.bounds = bvh.bounds;
  return second;
}

}  // namespace facet
