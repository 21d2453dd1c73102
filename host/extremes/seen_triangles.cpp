// Solid angles of triangles, and points uniform by them, from what they are: the part of the solid
// angle beside a point, and the part of the arc to it (J. Arvo, "Stratified Sampling of Spherical
// Triangles", SIGGRAPH 1995, without its inverse).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "extremes/function.h"
#include "shared/bindings.h"
#include "shared/extreme_inputs.h"
#include "shared/records.h"

namespace facet::extremes {

namespace {

template <typename Real>
using Triple = std::array<Real, 3>;

template <typename Real>
Real inner(const Triple<Real>& a, const Triple<Real>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <typename Real>
Triple<Real> outer(const Triple<Real>& a, const Triple<Real>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The sum of two directions, weighted.
template <typename Real>
Triple<Real> blend(const Real& s, const Triple<Real>& a, const Real& t, const Triple<Real>& b) {
  return {s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]};
}

/// Of the triangle of three unit directions (A. van Oosterom, J. Strackee 1983).
template <typename Real>
Real solid_angle_of(const Triple<Real>& a, const Triple<Real>& b, const Triple<Real>& c) {
  using std::abs;
  using std::atan2;
  return 2 *
         atan2(Real(abs(inner(a, outer(b, c)))), Real(1 + inner(a, b) + inner(b, c) + inner(c, a)));
}

template <typename Real>
struct ViewedTriangle {
  std::array<Triple<Real>, 3> directions;
  Triple<Real> distances;

  explicit ViewedTriangle(std::uint32_t index) {
    using std::sqrt;
    const vec3 from = shared::extreme_viewer(index);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const vec3 v = shared::extreme_corner(index, k);
      const Triple<Real> to{Real(v.x) - Real(from.x), Real(v.y) - Real(from.y),
                            Real(v.z) - Real(from.z)};
      distances.at(k) = sqrt(inner(to, to));
      for (std::size_t i = 0; i < 3; ++i) directions.at(k).at(i) = to.at(i) / distances.at(k);
    }
  }
  /// Sine of the angle between the plane and the direction to the first vertex, and the triangle's
  /// width over its longest edge.
  [[nodiscard]] std::array<Real, 2> height_and_width() const {
    using std::abs;
    using std::sqrt;
    const auto edge = [&](std::size_t k, std::size_t i) {
      return blend(distances.at(k), directions.at(k), Real(-distances.at(i)), directions.at(i));
    };
    const Triple<Real> normal = outer(edge(1, 0), edge(2, 0));
    const Real area = sqrt(inner(normal, normal));
    Real longest2 = 0;
    for (std::size_t k = 0; k < 3; ++k)
      longest2 = std::max(longest2, inner(edge(k, (k + 1) % 3), edge(k, (k + 1) % 3)));
    return {abs(inner(normal, directions[0])) / area, area / longest2};
  }
  [[nodiscard]] Real solid_angle() const {
    return solid_angle_of(directions[0], directions[1], directions[2]);
  }

  /// Barycentric weights of the point (u, v).
  [[nodiscard]] Triple<Real> point(const Real& u, const Real& v) const {
    using std::acos;
    using std::sin;
    using std::sqrt;
    const auto& [a, b, c] = directions;
    const Real part = u * solid_angle();
    const Real side = acos(inner(a, c));
    // The end of the arc from b, by its angle from a.
    const auto end = [&, &from = a, &to = c](const Real& angle) {
      return blend(Real(sin(side - angle) / sin(side)), from, Real(sin(angle) / sin(side)), to);
    };
    Real low = 0;
    Real high = side;
    constexpr int halvings = sizeof(Real) == sizeof(double) ? 50 : 150;
    for (int i = 0; i < halvings; ++i) {
      const Real middle = (low + high) / 2;
      (solid_angle_of(a, b, end(middle)) < part ? low : high) = middle;
    }
    const Triple<Real> e = end(low);
    const Real cosine = inner(b, e);
    // The point's direction is of_b b + of_e e, and its cosine to b is 1 - v (1 - cosine).
    const Real along = 1 - v * (1 - cosine);
    const Real of_e = sqrt((1 - along * along) / (1 - cosine * cosine));
    const Real of_b = along - of_e * cosine;
    Triple<Real> weights{of_e * sin(side - low) / sin(side) / distances[0], of_b / distances[1],
                         of_e * sin(low) / sin(side) / distances[2]};
    const Real sum = weights[0] + weights[1] + weights[2];
    for (Real& w : weights) w /= sum;
    return weights;
  }
};

/// How well floats tell what is seen: the least of the triangle's width over its length, the sine
/// between its plane and the direction to a vertex, and how far directions to two are from
/// opposite.
double clearness(const ViewedTriangle<double>& triangle) {
  const auto [height, width] = triangle.height_and_width();
  double least = std::min(height, width);
  for (std::size_t k = 0; k < 3; ++k) {
    const Triple<double> sum =
        blend(1.0, triangle.directions.at(k), 1.0, triangle.directions.at((k + 1) % 3));
    least = std::min(least, std::sqrt(inner(sum, sum)));
  }
  return least;
}

/// In what errors are measured of a triangle that emitters are sampled by the solid angle of; below
/// 0 for all others. clear: of those with a clearness of at least 0.01, more where it is below 0.1;
/// else of the others.
double yardstick_of(std::uint32_t index, bool clear) {
  const ViewedTriangle<double> triangle(index);
  const double solid_angle = triangle.solid_angle();
  const double clearness_of_it = clearness(triangle);
  const bool sampled = solid_angle >= static_cast<double>(shared::SMALLEST_SEEN) &&
                       solid_angle <= static_cast<double>(shared::LARGEST_SEEN);
  // In the plane itself the solid angle has no value.
  if (!sampled || (clearness_of_it >= 0.01) != clear || clearness_of_it < 1e-12) return -1;
  return clear ? std::max(1.0, 0.1 / clearness_of_it) : 1;
}

std::string text_of_view(std::uint32_t index) {
  const vec3 from = shared::extreme_viewer(index);
  const glm::vec4 n = shared::leaving_numbers(index);
  return fmt::format("{}, from ({:.9g}, {:.9g}, {:.9g}), u {:.9g}, v {:.9g}", triangle_text(index),
                     from.x, from.y, from.z, n.x, n.y);
}

constexpr WordRange views{0, 1U << 24U};
constexpr const char* view_range =
    "triangles as those that rays leave, from up to 16 of their sizes away, that fill 0.001 to 6 "
    "sr "
    "and have a clearness of 0.01 (the least of width over length, sin(plane, a), |a + b|, |b + c| "
    "and |c + a|, of the directions to the corners); in units of max(1, 0.1/clearness)";

Check seen_check(const char* name, bool clear, const char* unit, double limit, Function f) {
  f.name = text_of_view;
  Check check = check_of("pieces of models", name, view_range, limit, std::move(f), {views});
  check.name = fmt::format("{}{}", name, clear ? "" : ", unclear");
  if (!clear) {
    check.range = "the same, of less clearness";
    check.argued =
        "Needles, triangles seen edge on, and from beside an edge: a rounding of a direction or an "
        "edge is as much of what they tell. Density and sample use the same numbers.";
  }
  check.unit = unit;
  return check;
}

Check solid_angle_check(bool clear) {
  Function f;
  f.number = shared::FUNCTION_SEEN_SOLID_ANGLE;
  f.in_double = [](std::uint32_t i) { return ViewedTriangle<double>(i).solid_angle(); };
  f.exact = [](std::uint32_t i) { return ViewedTriangle<Exact>(i).solid_angle(); };
  f.yardstick = [clear](std::uint32_t i, double value) {
    const double yardstick = yardstick_of(i, clear);
    return yardstick < 0 ? -1 : value * yardstick;
  };
  return seen_check("solid angle of a triangle", clear, "relative error", 1e-5, std::move(f));
}

Check point_check(const char* name, std::uint32_t number, std::size_t corner, bool clear) {
  Function f;
  f.number = number;
  f.in_double = [corner](std::uint32_t i) {
    const glm::vec4 n = shared::leaving_numbers(i);
    return ViewedTriangle<double>(i).point(n.x, n.y).at(corner);
  };
  f.exact = [corner](std::uint32_t i) {
    const glm::vec4 n = shared::leaving_numbers(i);
    return ViewedTriangle<Exact>(i).point(Exact(n.x), Exact(n.y)).at(corner);
  };
  f.yardstick = [clear](std::uint32_t i, double /*value*/) { return yardstick_of(i, clear); };
  return seen_check(name, clear, "error of a weight", 1e-4, std::move(f));
}

}  // namespace

std::vector<Check> seen_triangle_checks() {
  std::vector<Check> checks;
  for (const bool clear : {true, false}) {
    checks.push_back(solid_angle_check(clear));
    checks.push_back(point_check("point by solid angle, weight of v1",
                                 shared::FUNCTION_SEEN_POINT_B1, 1, clear));
    checks.push_back(point_check("point by solid angle, weight of v2",
                                 shared::FUNCTION_SEEN_POINT_B2, 2, clear));
  }
  return checks;
}

}  // namespace facet::extremes
