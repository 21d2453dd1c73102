#pragma once

#include "vec3.h"

/// Signed distances (negative inside) and how they combine; all lengths in the units of the points
/// passed in. After the collection of Inigo Quilez, "Distance functions" (iquilezles.org).
namespace facet::generate {

/// Distance to an axis-aligned ellipsoid of the given half axes: exact on the surface and to first
/// order near it.
inline double ellipsoid(Vec3 p, Vec3 centre, Vec3 axes) {
  const Vec3 q = p - centre;
  const Vec3 once{q.x / axes.x, q.y / axes.y, q.z / axes.z};
  const Vec3 twice{once.x / axes.x, once.y / axes.y, once.z / axes.z};
  const double k0 = length(once);
  const double k1 = length(twice);
  // At the very centre the quotient is 0/0; any inside distance will do there.
  return k1 > 1e-9 ? k0 * (k0 - 1.0) / k1 : -std::min({axes.x, axes.y, axes.z});
}

inline double sphere(Vec3 p, Vec3 centre, double radius) { return length(p - centre) - radius; }

/// Distance to a capsule from `a` to `b` whose radius runs linearly from `radius_a` to `radius_b`.
inline double tapered_capsule(Vec3 p, Vec3 a, Vec3 b, double radius_a, double radius_b) {
  const Vec3 axis = b - a;
  const double t = std::clamp(dot(p - a, axis) / dot(axis, axis), 0.0, 1.0);
  return length(p - a - axis * t) - (radius_a + (radius_b - radius_a) * t);
}

/// Distance to a vertical cylinder of the given radius between two heights, its edges rounded by
/// `rounding`.
inline double cylinder(Vec3 p, Vec3 base, double top, double radius, double rounding) {
  const double dx = std::hypot(p.x - base.x, p.z - base.z) - radius + rounding;
  const double half = 0.5 * (top - base.y);
  const double dy = std::abs(p.y - base.y - half) - half + rounding;
  return std::min(std::max(dx, dy), 0.0) + std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) -
         rounding;
}

/// Distance to a horizontal ring around the vertical through `centre`.
inline double ring(Vec3 p, Vec3 centre, double radius, double thickness) {
  const double radial = std::hypot(p.x - centre.x, p.z - centre.z) - radius;
  return std::hypot(radial, p.y - centre.y) - thickness;
}

/// Union with a blend of width `k` (polynomial smooth minimum).
inline double join(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k * 0.25;
}

/// `a` without `b`, blended over the width `k`.
inline double carve(double a, double b, double k) { return -join(-a, b, k); }

}  // namespace facet::generate
