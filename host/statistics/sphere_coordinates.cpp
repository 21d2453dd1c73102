#include "statistics/sphere_coordinates.h"

#include <cmath>

namespace facet::statistics {

SphereCoordinates::SphereCoordinates(const vec3& wo) {
  const double radius = std::hypot(static_cast<double>(wo.x), static_cast<double>(wo.y));
  if (radius == 0) return;
  axis_x_ = -static_cast<double>(wo.x) / radius;
  axis_y_ = -static_cast<double>(wo.y) / radius;
}

Coordinates SphereCoordinates::of(const vec3& w) const {
  const double x = w.x;
  const double y = w.y;
  const double height = std::abs(static_cast<double>(w.z));
  Coordinates c;
  c.side = w.z >= 0 ? 0 : 1;
  // 1 - |z| cancels near the pole; the other form carries the rounding of x and y where z is small.
  c.v = height > 0.5 ? (x * x + y * y) / (1 + height) : 1 - height;
  c.phi = std::atan2(y * axis_x_ - x * axis_y_, x * axis_x_ + y * axis_y_);
  return c;
}

vec3 SphereCoordinates::direction(const Coordinates& c) const {
  const double radius = std::sqrt(c.v * (2 - c.v));
  const double along = radius * std::cos(c.phi);
  const double across = radius * std::sin(c.phi);
  return {static_cast<float>(along * axis_x_ - across * axis_y_),
          static_cast<float>(along * axis_y_ + across * axis_x_), static_cast<float>(c.cosine())};
}

}  // namespace facet::statistics
