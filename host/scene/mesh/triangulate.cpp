#include "scene/mesh/triangulate.h"

#include <algorithm>
#include <numeric>

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

class EarClipper {
 public:
  explicit EarClipper(std::span<const vec3> polygon)
      : polygon_(polygon), normal_(area_vector(polygon)), left_(polygon.size()) {
    std::iota(left_.begin(), left_.end(), 0U);
    for (std::size_t i = 0; i < left_.size(); ++i) {
      if (!is_convex(at(i))) reflex_.push_back(left_[i]);
    }
  }

  std::vector<Triangle> clip() {
    std::vector<Triangle> triangles;
    std::size_t i = 0;
    // Without an ear left the polygon crosses itself, or has no area: then corners are clipped as they come.
    bool has_ears = true;
    while (left_.size() > 3) {
      if (has_ears) has_ears = find_ear(i);
      triangles.push_back(at(i));
      std::erase(reflex_, left_[i]);
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
      i = i % left_.size();
    }
    triangles.push_back(at(1));
    return triangles;
  }

 private:
  /// The triangle of a corner that is left and the two beside it.
  [[nodiscard]] Triangle at(std::size_t i) const {
    return {left_[i > 0 ? i - 1 : left_.size() - 1], left_[i], left_[i + 1 < left_.size() ? i + 1 : 0]};
  }

  /// Moves i on to a corner whose triangle holds no other; returns whether there is one.
  [[nodiscard]] bool find_ear(std::size_t& i) const {
    for (std::size_t tried = 0; tried < left_.size(); ++tried, i = (i + 1) % left_.size()) {
      if (is_ear(at(i))) return true;
    }
    return false;
  }

  [[nodiscard]] bool is_convex(const Triangle& t) const { return side(t[0], t[1], t[2]) > 0; }

  [[nodiscard]] bool is_ear(const Triangle& t) const {
    // None but reflex corners can be the first to enter a triangle.
    return is_convex(t) && std::none_of(reflex_.begin(), reflex_.end(), [&](std::uint32_t p) {
             // A corner where two others meet, as at the slit that joins a hole to its outline, is not in the
             // way.
             const auto is_there = [&](std::uint32_t corner) { return polygon_[corner] == polygon_[p]; };
             return std::none_of(t.begin(), t.end(), is_there) && side(t[0], t[1], p) >= 0 &&
                    side(t[1], t[2], p) >= 0 && side(t[2], t[0], p) >= 0;
           });
  }

  /// Positive where corner c is on the inner side of the line from a to b.
  [[nodiscard]] double side(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return glm::dot(glm::cross(difference(polygon_[b], polygon_[a]), difference(polygon_[c], polygon_[a])),
                    normal_);
  }

  std::span<const vec3> polygon_;
  dvec3 normal_;
  std::vector<std::uint32_t> left_;
  std::vector<std::uint32_t> reflex_;  ///< of these, those that were at the start
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
  const bool is_02_shorter = glm::length(difference(p[0], p[2])) < glm::length(difference(p[1], p[3]));
  const std::vector<Triangle>& shorter = is_02_shorter ? by02 : by13;
  const std::vector<Triangle>& longer = is_02_shorter ? by13 : by02;
  return is_inside(longer) && !is_inside(shorter) ? longer : shorter;
}

}  // namespace

std::vector<Triangle> triangulate(std::span<const vec3> polygon) {
  if (polygon.size() == 4) return triangulate_quadrilateral(polygon);
  return EarClipper(polygon).clip();
}

}  // namespace facet
