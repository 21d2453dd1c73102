#pragma once
// Directions as heights and azimuths, between which equal areas are equal solid angles.
#include <array>

#include "core/maths.h"

namespace facet::statistics {

/// A direction: dw = dv dphi.
struct Coordinates {
  int side = 0;    ///< 0: z >= 0, 1: below
  double v = 0;    ///< 1 - |z|, in [0, 1], exact near 0 and near 1
  double phi = 0;  ///< azimuth, in [-pi, pi]

  /// Of the angle to the z axis.
  [[nodiscard]] double cosine() const { return side == 0 ? 1 - v : v - 1; }
};

/// A rectangle in these coordinates.
struct Rectangle {
  int side = 0;
  std::array<double, 2> lower{};  ///< v, phi
  std::array<double, 2> upper{};

  [[nodiscard]] double area() const { return (upper[0] - lower[0]) * (upper[1] - lower[1]); }
};

/// Turns directions into coordinates and back.
class SphereCoordinates {
 public:
  /// Azimuths count from the x axis.
  SphereCoordinates() = default;
  /// Azimuths count from the one opposite to wo; from the x axis where wo is along z.
  explicit SphereCoordinates(const vec3& wo);

  [[nodiscard]] Coordinates of(const vec3& w) const;
  [[nodiscard]] vec3 direction(const Coordinates& c) const;

 private:
  double axis_x_ = 1;  ///< azimuth 0
  double axis_y_ = 0;
};

}  // namespace facet::statistics
