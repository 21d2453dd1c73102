#include "scene/mesh/point_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace facet {

namespace {

constexpr std::size_t members_a_leaf = 8;

/// Whether no point of the box can lie within the triangle; in doubt it can.
bool is_outside(const dvec2& low, const dvec2& high, const std::array<dvec2, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const dvec2 least = glm::min(glm::min(a, b), c);
  const dvec2 most = glm::max(glm::max(a, b), c);
  if (least.x > high.x || least.y > high.y || most.x < low.x || most.y < low.y) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec2& from = triangle[i];
    const dvec2 along = triangle[(i + 1) % 3] - from;
    // The corner of the box that lies farthest to the left of the side.
    const dvec2 corner(along.y < 0 ? high.x : low.x, along.x > 0 ? high.y : low.y);
    const double up = along.x * (corner.y - from.y);
    const double across = along.y * (corner.x - from.x);
    if (up - across < -1e-14 * (std::abs(up) + std::abs(across))) return true;
  }
  return false;
}

}  // namespace

PointTree::PointTree(std::span<const dvec2> points, std::vector<std::uint32_t> members)
    : points_(points),
      members_(std::move(members)),
      removed_(members_.size()),
      places_(points.size(), none) {
  while (leaves_ * members_a_leaf < members_.size()) leaves_ *= 2;
  nodes_.resize(2 * leaves_ - 1);
  build(0, {0, members_.size()});
  for (std::size_t i = 0; i < members_.size(); ++i)
    places_[members_[i]] = static_cast<std::uint32_t>(i);
}

void PointTree::build(std::size_t node, Range range) {
  Node& n = nodes_[node];
  n.low = dvec2(std::numeric_limits<double>::max());
  n.high = -n.low;
  n.left = static_cast<std::uint32_t>(range.end - range.begin);
  for (std::size_t i = range.begin; i < range.end; ++i) {
    n.low = glm::min(n.low, points_[members_[i]]);
    n.high = glm::max(n.high, points_[members_[i]]);
  }
  if (node + 1 >= leaves_) return;
  const int axis = n.high.x - n.low.x > n.high.y - n.low.y ? 0 : 1;
  const std::size_t middle = (range.begin + range.end) / 2;
  const auto at = [&](std::size_t i) { return members_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(
      at(range.begin), at(middle), at(range.end),
      [&](std::uint32_t a, std::uint32_t b) { return points_[a][axis] < points_[b][axis]; });
  build(2 * node + 1, {range.begin, middle});
  build(2 * node + 2, {middle, range.end});
}

void PointTree::remove(std::uint32_t member) {
  const std::uint32_t place = places_[member];
  if (place == none || removed_[place]) return;
  removed_[place] = true;
  Range range{0, members_.size()};
  std::size_t node = 0;
  for (;;) {
    --nodes_[node].left;
    if (node + 1 >= leaves_) return;
    const std::size_t middle = (range.begin + range.end) / 2;
    const bool is_right = place >= middle;
    (is_right ? range.begin : range.end) = middle;
    node = 2 * node + (is_right ? 2 : 1);
  }
}

bool PointTree::any_in_triangle(const std::array<dvec2, 3>& triangle) const {
  return search(0, {0, members_.size()}, triangle);
}

bool PointTree::search(std::size_t node, Range range, const std::array<dvec2, 3>& triangle) const {
  const Node& n = nodes_[node];
  if (n.left == 0 || is_outside(n.low, n.high, triangle)) return false;
  if (node + 1 < leaves_) {
    const std::size_t middle = (range.begin + range.end) / 2;
    return search(2 * node + 1, {range.begin, middle}, triangle) ||
           search(2 * node + 2, {middle, range.end}, triangle);
  }
  for (std::size_t i = range.begin; i < range.end; ++i) {
    if (removed_[i]) continue;
    const dvec2& p = points_[members_[i]];
    const auto& [a, b, c] = triangle;
    if (p != a && p != b && p != c && signed_area(a, b, p) >= 0 && signed_area(b, c, p) >= 0 &&
        signed_area(c, a, p) >= 0)
      return true;
  }
  return false;
}

}  // namespace facet
