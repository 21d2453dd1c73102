#include "accel/coinciding_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace facet {

namespace {

/// Areas of less than so much of the smaller triangle's are an edge's, met by rounding.
constexpr double least_share = 1e-5;

float largest_coordinate(const TriangleCorners& triangle) {
  float largest = 0;
  for (const vec3& p : triangle) {
    const vec3 size = glm::abs(p);
    largest = std::max({largest, size.x, size.y, size.z});
  }
  return largest;
}

double tolerance(float coordinate) { return 2 * 16 * 0x1p-24 * static_cast<double>(coordinate); }

/// A convex polygon: a triangle, or what is left of one.
class Polygon {
 public:
  explicit Polygon(const TriangleCorners& triangle) {
    std::copy(triangle.begin(), triangle.end(), corners_.begin());
  }

  [[nodiscard]] const dvec3* begin() const { return corners_.data(); }
  [[nodiscard]] const dvec3* end() const { return begin() + count_; }
  [[nodiscard]] const dvec3& operator[](std::size_t i) const { return corners_[i]; }

  /// Twice the area, times the normal.
  [[nodiscard]] dvec3 area_vector() const {
    dvec3 sum(0);
    for (std::size_t i = 2; i < count_; ++i)
      sum += glm::cross(corners_[i - 1] - corners_[0], corners_[i] - corners_[0]);
    return sum;
  }

  /// Cuts off what lies behind the plane through a point.
  void clip(const dvec3& point, const dvec3& normal) {
    const std::array<dvec3, most> old = corners_;
    const std::size_t old_count = count_;
    count_ = 0;
    for (std::size_t i = 0; i < old_count; ++i) {
      const dvec3& from = old[i];
      const dvec3& to = old[(i + 1) % old_count];
      const double from_distance = glm::dot(normal, from - point);
      const double to_distance = glm::dot(normal, to - point);
      if (from_distance >= 0) corners_[count_++] = from;
      if ((from_distance < 0) != (to_distance < 0))
        corners_[count_++] = from + (to - from) * (from_distance / (from_distance - to_distance));
    }
  }

 private:
  /// Each of three planes adds at most one corner, or by rounding two.
  static constexpr std::size_t most = 9;
  std::array<dvec3, most> corners_{};
  std::size_t count_ = 3;
};

/// Whether one edge of a alone keeps b off it. Almost all neighbours are told apart so, at a tenth
/// of what clipping takes.
bool is_beyond_an_edge(const Polygon& a, const dvec3& normal, const Polygon& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec3 inwards = glm::cross(normal, a[(i + 1) % 3] - a[i]);
    if (std::all_of(b.begin(), b.end(),
                    [&](const dvec3& p) { return glm::dot(inwards, p - a[i]) <= 0; }))
      return true;
  }
  return false;
}

Box inflated(const TriangleCorners& triangle) {
  Box box = bounds_of(triangle);
  const vec3 margin(static_cast<float>(tolerance(largest_coordinate(triangle))));
  box.lower -= margin;
  box.upper += margin;
  return box;
}

bool overlap(const Box& a, const Box& b) {
  return glm::all(glm::lessThanEqual(a.lower, b.upper)) &&
         glm::all(glm::lessThanEqual(b.lower, a.upper));
}

UnfilledVector<BvhPrimitive> primitives_of(const std::vector<TriangleCorners>& triangles) {
  UnfilledVector<BvhPrimitive> primitives(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    primitives[i] = BvhPrimitive(inflated(triangles[i]), static_cast<std::uint32_t>(i));
  return primitives;
}

}  // namespace

bool coincide(const TriangleCorners& a, const TriangleCorners& b) {
  const Polygon whole(a);
  const dvec3 area = whole.area_vector();
  const double size = glm::length(area);
  if (!(size > 0)) return false;
  const dvec3 normal = area / size;
  Polygon common(b);
  if (is_beyond_an_edge(whole, normal, common)) return false;
  const double least = least_share * std::min(size, glm::length(common.area_vector()));
  for (std::size_t i = 0; i < 3; ++i) {
    common.clip(whole[i], glm::cross(normal, whole[(i + 1) % 3] - whole[i]));
    if (!(std::abs(glm::dot(common.area_vector(), normal)) > least)) return false;
  }
  const double margin = tolerance(std::max(largest_coordinate(a), largest_coordinate(b)));
  return std::all_of(common.begin(), common.end(), [&](const dvec3& p) {
    return std::abs(glm::dot(normal, p - whole[0])) <= margin;
  });
}

CoincidenceFinder::CoincidenceFinder(std::vector<TriangleCorners> triangles)
    : triangles_(std::move(triangles)) {
  if (!triangles_.empty()) tree_.emplace(primitives_of(triangles_));
}

void CoincidenceFinder::find(const TriangleCorners& other, std::size_t most_looked_at,
                             const std::function<void(std::size_t)>& found) const {
  if (!tree_) return;
  const Box box = inflated(other);
  std::vector<BinaryBvh::Node> waiting{tree_->root()};
  std::size_t looked_at = 0;
  while (!waiting.empty() && looked_at < most_looked_at) {
    const BinaryBvh::Node node = waiting.back();
    waiting.pop_back();
    if (!overlap(tree_->box(node), box)) continue;
    if (!BinaryBvh::is_leaf(node)) {
      waiting.push_back(tree_->second(node));
      waiting.push_back(tree_->first(node));
      continue;
    }
    ++looked_at;
    if (coincide(triangles_[tree_->primitive(node)], other)) {
      found(tree_->primitive(node));
    }
  }
}

}  // namespace facet
