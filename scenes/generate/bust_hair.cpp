#include <array>

#include "bust_parts.h"
#include "distance.h"

namespace facet::generate {
namespace {

/// A lock of hair through three points, thinning towards its end, grooved along its length.
double lock_distance(Vec3 p, const std::array<Vec3, 3>& path, double radius) {
  const double upper = tapered_capsule(p, path[0], path[1], radius, 0.9 * radius);
  const double lower = tapered_capsule(p, path[1], path[2], 0.9 * radius, 0.45 * radius);
  const double d = join(upper, lower, 0.5 * radius);
  if (d > radius) return d;
  // Strands: waves across the lock, which drift along it, so that it seems twisted.
  const Vec3 q = p - path[1];
  const double across = q.x + 0.6 * q.z + 0.35 * q.y + 0.4 * q.y * q.y;
  return d + 0.10 * radius * std::cos(5.2 * across / radius);
}

double forehead_locks(Vec3 p) {
  // Five of them: the mark of Serapis.
  double d = 1e9;
  for (int i = -2; i <= 2; ++i) {
    const double x = 0.155 * i;
    const double depth = -0.10 * x * x * 10.0;
    const double bend = i == 0 ? 0.03 : 0.03 * (i > 0 ? 1 : -1);
    const std::array<Vec3, 3> path{{{0.9 * x, 0.92, 0.46 + depth},
                                    {x + bend, 0.68, 0.66 + depth},
                                    {1.08 * x - bend, 0.455, 0.675 + 0.8 * depth}}};
    d = join(d, lock_distance(p, path, 0.088), 0.02);
  }
  return d;
}

double side_locks(Vec3 p) {
  const Vec3 m{std::abs(p.x), p.y, p.z};
  const double sway = p.x > 0 ? 0.03 : -0.02;
  double d = lock_distance(
      m, {{{0.66, 0.45, 0.18}, {0.74 + sway, 0.05, 0.16}, {0.66, -0.40, 0.10}}}, 0.15);
  d = join(d,
           lock_distance(m, {{{0.68, 0.1, -0.05}, {0.72, -0.5, -0.05}, {0.60 + sway, -1.15, 0.12}}},
                         0.16),
           0.04);
  d = join(d,
           lock_distance(m, {{{0.50, 0.0, -0.45}, {0.52, -0.6, -0.42}, {0.48, -1.2, -0.40}}}, 0.22),
           0.06);
  return join(
      d, lock_distance(m, {{{0.12, 0.0, -0.65}, {0.16, -0.6, -0.60}, {0.15, -1.2, -0.55}}}, 0.26),
      0.06);
}

double moustache(Vec3 m) {
  return lock_distance(m, {{{0.035, -0.325, 0.80}, {0.19, -0.39, 0.735}, {0.32, -0.60, 0.62}}},
                       0.062);
}

double beard_strands(Vec3 p) {
  const Vec3 m{std::abs(p.x), p.y, p.z};
  double d = ellipsoid(m, {0, -0.80, 0.36}, {0.44, 0.30, 0.36});
  d = join(d, tapered_capsule(m, {0.50, -0.05, 0.22}, {0.38, -0.60, 0.38}, 0.10, 0.17), 0.10);
  // The two points of the beard, not quite alike.
  const double tip = p.x > 0 ? -1.34 : -1.30;
  const double inner =
      lock_distance(m, {{{0.14, -0.72, 0.66}, {0.17, -1.02, 0.60}, {0.10, tip, 0.50}}}, 0.135);
  const double outer =
      lock_distance(m, {{{0.31, -0.62, 0.53}, {0.37, -0.92, 0.48}, {0.26, -1.22, 0.42}}}, 0.135);
  d = join(d, join(inner, outer, 0.03), 0.04);
  return join(d, moustache(m), 0.02);
}

bool is_hair(Vec3 p) {
  const bool on_face = p.z > 0.22 && p.y < 0.72 && std::abs(p.x) < 0.66;
  const bool under_kalathos = p.y > 0.98;
  return !on_face && !under_kalathos && p.y > -0.45;
}

bool is_beard(Vec3 p) {
  const bool on_mouth = p.y > -0.60 && std::abs(p.x) < 0.34;
  return p.z > 0.18 && p.y < -0.12 && !on_mouth;
}

std::vector<Curls::Curl> all_curls() {
  auto curls = scatter_curls({0, 0.20, -0.10}, {0.76, 0.86, 0.86}, 190, 0.150, is_hair);
  const auto beard = scatter_curls({0, -0.62, 0.30}, {0.50, 0.50, 0.44}, 120, 0.098, is_beard);
  curls.insert(curls.end(), beard.begin(), beard.end());
  return curls;
}

}  // namespace

Hair::Hair() : curls_(all_curls()) {}

double Hair::distance(Vec3 p) const {
  double d = ellipsoid(p, {0, 0.22, -0.14}, {0.70, 0.82, 0.82});
  // The hair's body ends at the hairline; only locks and curls hang over the face.
  d = carve(d, ellipsoid(p, {0, 0.05, 0.75}, {0.60, 0.66, 0.62}), 0.04);
  d = join(d, side_locks(p), 0.05);
  d = join(d, forehead_locks(p), 0.02);
  d = join(d, beard_strands(p), 0.03);
  // `distance` of the curls may be cut off at their reach, where it is at most that of what they
  // sit on.
  return d > 0.35 ? d - 0.2 : join(d, curls_.distance(p, 0.4), 0.02);
}

}  // namespace facet::generate
