#include "scene/mesh/triangulate.h"

#include <deque>

#include "scene/mesh/point_tree.h"

namespace facet {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Of floats of any size, without overflow.
dvec3 difference(const vec3& a, const vec3& b) { return dvec3(a) - dvec3(b); }

/// Twice the polygon's area, as a normal (Newell's).
dvec3 area_vector(std::span<const vec3> polygon) {
  dvec3 sum(0);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const vec3& next = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    sum += glm::cross(difference(polygon[i], polygon.front()), difference(next, polygon.front()));
  }
  return sum;
}

/// Seen along the axis nearest to the polygon's normal, so that it winds counterclockwise.
std::vector<dvec2> projected(std::span<const vec3> polygon) {
  const dvec3 normal = area_vector(polygon);
  const dvec3 size = glm::abs(normal);
  const int axis = size.x > size.y && size.x > size.z ? 0 : (size.y > size.z ? 1 : 2);
  const int u = (axis + (normal[axis] < 0 ? 2 : 1)) % 3;
  const int v = (axis + (normal[axis] < 0 ? 1 : 2)) % 3;
  std::vector<dvec2> points;
  points.reserve(polygon.size());
  for (const vec3& p : polygon) points.emplace_back(p[u], p[v]);
  return points;
}

/// Clips one ear after another. Those beside a clipped ear wait until all others had their turn: so
/// the triangles stay as wide as the polygon allows.
class EarClipper {
 public:
  explicit EarClipper(std::span<const vec3> polygon)
      : points_(projected(polygon)),
        left_(static_cast<std::uint32_t>(polygon.size())),
        before_(left_),
        behind_(left_),
        turn_(left_),
        reflex_(points_, reflex_corners()) {
    triangles_.reserve(left_ - 2);
    for (std::uint32_t i = 0; i < left_; ++i) {
      before_[i] = (i > 0 ? i : left_) - 1;
      behind_[i] = i + 1 < left_ ? i + 1 : 0;
      enqueue(i);
    }
  }

  std::vector<Triangle> clip() {
    std::uint32_t last_left = 0;
    while (left_ > 3) {
      clip_ears();
      if (left_ <= 3) break;
      // Where it touches or crosses itself, an ear can come up that is not beside a clipped one:
      // look again, unless hardly any did.
      if (last_left == 0 || left_ < last_left - last_left / 16) {
        last_left = left_;
        std::uint32_t i = start_;
        do enqueue(i);
        while ((i = behind_[i]) != start_);
      } else {
        clip_without_ear();
      }
    }
    triangles_.push_back(at(behind_[start_]));
    return std::move(triangles_);
  }

 private:
  struct Turn {
    std::uint32_t corner;
    std::uint32_t number;
  };

  /// Corners that do not bend to the left, those beside them at the start.
  [[nodiscard]] std::vector<std::uint32_t> reflex_corners() const {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i < left_; ++i) {
      if (!(signed_area(points_[(i > 0 ? i : left_) - 1], points_[i],
                        points_[i + 1 < left_ ? i + 1 : 0]) > 0))
        corners.push_back(i);
    }
    return corners;
  }

  void enqueue(std::uint32_t corner) { queue_.push_back({corner, ++turn_[corner]}); }

  void clip_ears() {
    while (left_ > 3 && !queue_.empty()) {
      const Turn turn = queue_.front();
      queue_.pop_front();
      if (turn_[turn.corner] == turn.number && is_ear(turn.corner)) clip(turn.corner);
    }
  }

  /// Takes out a corner that adds no area, or where there is none, any.
  void clip_without_ear() {
    for (std::uint32_t tried = 0; has_flat_ && tried < left_; ++tried, start_ = behind_[start_]) {
      if (area(start_) == 0) return clip(start_);
    }
    has_flat_ = false;
    clip(start_);
  }

  void clip(std::uint32_t corner) {
    const auto [previous, self, next] = at(corner);
    triangles_.push_back({previous, self, next});
    behind_[previous] = next;
    before_[next] = previous;
    if (start_ == corner) start_ = next;
    --left_;
    ++turn_[corner];
    reflex_.remove(corner);
    for (const std::uint32_t neighbour : {previous, next}) {
      if (area(neighbour) > 0) reflex_.remove(neighbour);
      enqueue(neighbour);
    }
  }

  /// The triangle of a corner that is left and the two beside it.
  [[nodiscard]] Triangle at(std::uint32_t corner) const {
    return {before_[corner], corner, behind_[corner]};
  }

  [[nodiscard]] double area(std::uint32_t corner) const {
    return signed_area(points_[before_[corner]], points_[corner], points_[behind_[corner]]);
  }

  /// None but reflex corners can be the first to enter a triangle. One where two others meet, as at
  /// the slit that joins a hole to its outline, is not in the way.
  [[nodiscard]] bool is_ear(std::uint32_t corner) const {
    const auto [a, b, c] = at(corner);
    return area(corner) > 0 && !reflex_.any_in_triangle({points_[a], points_[b], points_[c]});
  }

  std::vector<dvec2> points_;
  std::uint32_t left_;                 ///< corners
  std::vector<std::uint32_t> before_;  ///< the corner before each that is left
  std::vector<std::uint32_t> behind_;
  std::vector<std::uint32_t> turn_;  ///< number of each corner's last turn in the queue
  PointTree reflex_;
  std::deque<Turn> queue_;
  std::uint32_t start_ = 0;  ///< a corner that is left
  bool has_flat_ = true;
  std::vector<Triangle> triangles_;
};

/// Along the shorter diagonal, unless that leaves the quadrilateral.
std::vector<Triangle> triangulate_quadrilateral(std::span<const vec3> p) {
  const auto normal = [&](const Triangle& t) {
    return glm::cross(difference(p[t[1]], p[t[0]]), difference(p[t[2]], p[t[0]]));
  };
  const auto is_inside = [&](const std::vector<Triangle>& halves) {
    return glm::dot(normal(halves[0]), normal(halves[1])) > 0;
  };
  const std::vector<Triangle> by02{{0, 1, 2}, {0, 2, 3}};
  const std::vector<Triangle> by13{{0, 1, 3}, {1, 2, 3}};
  const bool is_02_shorter =
      glm::length(difference(p[0], p[2])) < glm::length(difference(p[1], p[3]));
  const std::vector<Triangle>& shorter = is_02_shorter ? by02 : by13;
  const std::vector<Triangle>& longer = is_02_shorter ? by13 : by02;
  return is_inside(longer) && !is_inside(shorter) ? longer : shorter;
}

/// Of a polygon of which no two consecutive corners are at one place.
std::vector<Triangle> triangulate_distinct(std::span<const vec3> polygon) {
  if (polygon.size() < 3) return {};
  if (polygon.size() == 3) return {{0, 1, 2}};
  if (polygon.size() == 4) return triangulate_quadrilateral(polygon);
  return EarClipper(polygon).clip();
}

}  // namespace

std::vector<Triangle> triangulate(std::span<const vec3> polygon) {
  std::vector<std::uint32_t> kept;
  std::vector<vec3> corners;
  for (std::uint32_t i = 0; i < polygon.size(); ++i) {
    if (!corners.empty() && corners.back() == polygon[i]) continue;
    kept.push_back(i);
    corners.push_back(polygon[i]);
  }
  while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
  std::vector<Triangle> triangles = triangulate_distinct(corners);
  for (Triangle& t : triangles) t = {kept[t[0]], kept[t[1]], kept[t[2]]};
  return triangles;
}

}  // namespace facet
