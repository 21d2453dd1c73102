#include "accel/leaf_boxes.h"

#include <algorithm>
#include <array>
#include <queue>

#include "core/parallel.h"

namespace facet {

namespace {

/// Places with fewer boxes stay as they are.
constexpr std::size_t least_crowd = 2048;
/// Boxes for each pair in crowded nodes, at most; twice as many where a traversal could not visit
/// all of a crowd's.
constexpr std::size_t most_pieces = 24;
constexpr std::size_t most_visited = 1U << 14U;
/// A division is worth while if rays meet less than this share of the boxes afterwards.
constexpr double worth_while = 0.9;

/// The part of a pair that lies in a box.
struct Piece {
  std::uint32_t pair = 0;
  Box box;
};

/// Where many boxes overlap.
struct Crowd {
  std::vector<Piece> pieces;
  Box bounds;
  double area = 0;  ///< sum of the boxes' half areas

  void add(const Piece& piece) {
    pieces.push_back(piece);
    bounds.add(piece.box);
    area += piece.box.half_area();
  }
  /// Proportional to the leaves that a random ray meets if all boxes were as large as the bounds.
  [[nodiscard]] double cost() const {
    return bounds.half_area() * static_cast<double>(pieces.size());
  }
  /// Time is lost where rays meet many boxes, but images are wrong where they meet more than a
  /// traversal can visit: a small place with very many counts as much as a large one with many.
  [[nodiscard]] double urgency() const { return cost() * static_cast<double>(pieces.size()); }
};

/// The most urgent first, of equal ones those that came first.
struct QueuedCrowd {
  double urgency;
  std::size_t number;

  [[nodiscard]] bool operator<(const QueuedCrowd& other) const {
    return urgency != other.urgency ? urgency < other.urgency : number > other.number;
  }
};

Box common_part(const Box& a, const Box& b) {
  return {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)};
}

int longest_axis(const vec3& extent) {
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

float median(const std::vector<Piece>& pieces, int axis, vec3 Box::*end) {
  std::vector<float> values(pieces.size());
  std::transform(pieces.begin(), pieces.end(), values.begin(),
                 [&](const Piece& piece) { return (piece.box.*end)[axis]; });
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What a division costs, judged by boxes alone.
double cost_of(const Crowd& crowd, int axis, float plane) {
  std::array<Box, 2> sides{crowd.bounds, crowd.bounds};
  sides[0].upper[axis] = sides[1].lower[axis] = plane;
  std::array<std::size_t, 2> counts{};
  for (const Piece& piece : crowd.pieces) {
    if (piece.box.lower[axis] < plane) ++counts[0];
    if (piece.box.upper[axis] > plane) ++counts[1];
  }
  return sides[0].half_area() * static_cast<double>(counts[0]) +
         sides[1].half_area() * static_cast<double>(counts[1]);
}

/// The middle, or where that is clearly better a place where many triangles begin or end, such as
/// their common corner.
float best_plane(const Crowd& crowd, int axis) {
  const float lower = crowd.bounds.lower[axis];
  const float upper = crowd.bounds.upper[axis];
  float best = 0.5F * lower + 0.5F * upper;
  double least = worth_while * cost_of(crowd, axis, best);
  for (const auto end : {&Box::lower, &Box::upper}) {
    const float plane = median(crowd.pieces, axis, end);
    if (!(plane > lower && plane < upper)) continue;
    const double cost = cost_of(crowd, axis, plane);
    if (cost < least) best = plane, least = cost;
  }
  return best;
}

/// Adds what of the triangle lies to either side of a plane to the boxes of the two sides, and a
/// margin where the plane cuts it: as much as intersection tests err, which is relative to the
/// whole triangle, however small its parts are.
void add_sides(const TriangleCorners& triangle, int axis, float plane, std::array<Box, 2>& sides) {
  const Box whole = bounds_of(triangle);
  const vec3 extent = whole.extent();
  const vec3 margin = 0x1p-21F * (extent.x + extent.y + extent.z) +
                      0x1p-23F * glm::max(glm::abs(whole.lower), glm::abs(whole.upper));
  for (std::size_t i = 0; i < 3; ++i) {
    const vec3& from = triangle[i];
    const vec3& to = triangle[(i + 1) % 3];
    if (from[axis] <= plane) sides[0].add(from);
    if (from[axis] >= plane) sides[1].add(from);
    if ((from[axis] < plane) == (to[axis] < plane) || from[axis] == plane || to[axis] == plane)
      continue;
    const double share =
        (static_cast<double>(plane) - from[axis]) / (static_cast<double>(to[axis]) - from[axis]);
    const vec3 crossing(dvec3(from) + (dvec3(to) - dvec3(from)) * share);
    for (Box& side : sides) side.add(Box{crossing - margin, crossing + margin});
  }
}

class Divider {
 public:
  Divider(std::span<const TrianglePair> pairs, std::span<const TriangleCorners> triangles)
      : pairs_(pairs), triangles_(triangles) {}

  void add(Crowd crowd) {
    piece_count_ += crowd.pieces.size();
    if (crowd.pieces.size() > least_crowd) waiting_.push({crowd.urgency(), crowds_.size()});
    crowds_.push_back(std::move(crowd));
  }

  /// Divides where rays meet most boxes until no crowd is large, or too many pieces are made.
  void divide(std::size_t most_copies) {
    const std::size_t largest = piece_count_ + most_copies;
    const std::size_t most = most_pieces * piece_count_;
    while (!waiting_.empty()) {
      const std::size_t number = waiting_.top().number;
      waiting_.pop();
      const std::size_t size = crowds_[number].pieces.size();
      divide_crowd(number, std::min(largest, size > most_visited ? 2 * most : most));
    }
  }

  [[nodiscard]] const std::vector<Crowd>& crowds() const { return crowds_; }

 private:
  /// Unless that helps little, or makes more than so many pieces in all.
  void divide_crowd(std::size_t number, std::size_t limit) {
    const Crowd& whole = crowds_[number];
    const int axis = longest_axis(whole.bounds.extent());
    const float plane = best_plane(whole, axis);
    std::array<Crowd, 2> halves;
    for (const Piece& piece : whole.pieces) divide_piece(piece, axis, plane, halves);
    const bool parts_them = halves[0].cost() + halves[1].cost() < worth_while * whole.cost();
    const bool shrinks_them = halves[0].area + halves[1].area < worth_while * whole.area;
    if (!parts_them && !shrinks_them) return;
    const std::size_t others = piece_count_ - whole.pieces.size();
    if (others + halves[0].pieces.size() + halves[1].pieces.size() > limit) return;
    piece_count_ = others;
    crowds_[number] = Crowd();
    for (Crowd& half : halves) add(std::move(half));
  }

  void divide_piece(const Piece& piece, int axis, float plane, std::array<Crowd, 2>& halves) const {
    if (piece.box.upper[axis] <= plane) return halves[0].add(piece);
    if (piece.box.lower[axis] >= plane) return halves[1].add(piece);
    std::array<Box, 2> sides;
    const TrianglePair& pair = pairs_[piece.pair];
    add_sides(triangles_[pair.first], axis, plane, sides);
    if (pair.second != none) add_sides(triangles_[pair.second], axis, plane, sides);
    for (std::size_t side = 0; side < 2; ++side) {
      const Box box = common_part(sides[side], piece.box);
      const bool holds_some = glm::all(glm::lessThanEqual(box.lower, box.upper));
      if (holds_some) halves[side].add({piece.pair, box});
    }
  }

  std::span<const TrianglePair> pairs_;
  std::span<const TriangleCorners> triangles_;
  std::vector<Crowd> crowds_;  ///< those that were divided are empty
  std::priority_queue<QueuedCrowd> waiting_;
  std::size_t piece_count_ = 0;
};

/// Of each inner node, the sum of the half areas of the leaves below it.
std::vector<double> leaf_areas(const BinaryBvh& binary) {
  std::vector<double> areas(binary.inner_count());
  const auto area_of = [&](BinaryBvh::Node node) {
    return BinaryBvh::is_leaf(node) ? static_cast<double>(binary.box(node).half_area())
                                    : areas[node];
  };
  // What lies below a node follows it.
  for (std::size_t i = areas.size(); i-- > 0;) {
    const auto node = static_cast<BinaryBvh::Node>(i);
    areas[i] = area_of(binary.first(node)) + area_of(binary.second(node));
  }
  return areas;
}

/// Calls `found` with the leaves below each crowded node that is not below another.
template <typename Found>
void for_each_crowded(const BinaryBvh& binary, const Found& found) {
  const std::vector<double> areas = leaf_areas(binary);
  std::vector<BinaryBvh::Node> waiting{binary.root()};
  const auto descend = [&](BinaryBvh::Node node) {
    waiting.push_back(binary.second(node));
    waiting.push_back(binary.first(node));
  };
  while (!waiting.empty()) {
    const BinaryBvh::Node node = waiting.back();
    waiting.pop_back();
    if (BinaryBvh::is_leaf(node)) continue;
    if (areas[node] <= most_met_leaves * binary.box(node).half_area()) {
      descend(node);
      continue;
    }
    std::vector<BinaryBvh::Node> leaves;
    const std::size_t outside = waiting.size();
    descend(node);
    while (waiting.size() > outside) {
      const BinaryBvh::Node below = waiting.back();
      waiting.pop_back();
      if (BinaryBvh::is_leaf(below)) {
        leaves.push_back(below);
      } else {
        descend(below);
      }
    }
    found(leaves);
  }
}

}  // namespace

LeafBoxes make_leaf_boxes(std::span<const TrianglePair> pairs,
                          std::span<const TriangleCorners> triangles) {
  LeafBoxes boxes{UnfilledVector<BvhPrimitive>(pairs.size()), pairs.size(), {}};
  parallel_for(pairs.size(), 1U << 14U, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Box box = bounds_of(triangles[pairs[i].first]);
      if (pairs[i].second != none) box.add(bounds_of(triangles[pairs[i].second]));
      boxes.primitives[i] = BvhPrimitive(box, static_cast<std::uint32_t>(i));
    }
  });
  return boxes;
}

LeafBoxes divide_crowded(const BinaryBvh& binary, std::span<const TrianglePair> pairs,
                         std::span<const TriangleCorners> triangles, std::size_t most_copies) {
  Divider divider(pairs, triangles);
  for_each_crowded(binary, [&](const std::vector<BinaryBvh::Node>& leaves) {
    Crowd crowd;
    for (const BinaryBvh::Node leaf : leaves) crowd.add({binary.primitive(leaf), binary.box(leaf)});
    divider.add(std::move(crowd));
  });
  divider.divide(most_copies);
  LeafBoxes divided = make_leaf_boxes(pairs, triangles);
  std::vector<bool> known(pairs.size());
  for (const Crowd& crowd : divider.crowds()) {
    for (const Piece& piece : crowd.pieces) {
      if (!known[piece.pair]) {
        known[piece.pair] = true;
        divided.primitives[piece.pair] = BvhPrimitive(piece.box, piece.pair);
        continue;
      }
      const std::size_t index = pairs.size() + divided.copies.size();
      divided.primitives.emplace_back(piece.box, static_cast<std::uint32_t>(index));
      divided.copies.push_back(piece.pair);
    }
  }
  return divided;
}

}  // namespace facet
