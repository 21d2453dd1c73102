#include "bust_parts.h"
#include "distance.h"

namespace facet::generate {
namespace {

/// `m` is mirrored to x >= 0 in all of these: the face is symmetric, the hair is not.
double skull(Vec3 m) {
  double d = ellipsoid(m, {0, 0.22, -0.12}, {0.66, 0.78, 0.80});
  d = join(d, ellipsoid(m, {0, -0.12, 0.20}, {0.53, 0.78, 0.55}), 0.20);
  d = join(d, ellipsoid(m, {0, -0.52, 0.25}, {0.40, 0.38, 0.45}), 0.15);
  d = join(d, ellipsoid(m, {0.36, -0.10, 0.45}, {0.17, 0.14, 0.19}), 0.15);
  return join(d, tapered_capsule(m, {0, -0.5, -0.18}, {0, -1.7, -0.25}, 0.42, 0.50), 0.15);
}

double add_brow(double d, Vec3 m) {
  // Antique brows are sharp: a steep frown at the nose, falling to the temple.
  d = join(d, tapered_capsule(m, {0.05, 0.27, 0.70}, {0.28, 0.31, 0.66}, 0.075, 0.07), 0.07);
  d = join(d, tapered_capsule(m, {0.28, 0.31, 0.66}, {0.48, 0.20, 0.46}, 0.07, 0.05), 0.07);
  return join(d, ellipsoid(m, {0, 0.44, 0.55}, {0.34, 0.10, 0.16}), 0.10);
}

double add_eye(double d, Vec3 m) {
  const Vec3 eye{0.245, 0.12, 0.555};
  d = carve(d, sphere(m, {0.25, 0.13, 0.80}, 0.165), 0.10);
  d = carve(d, sphere(m, {0.10, 0.13, 0.80}, 0.05), 0.08);
  const double around = length(m - eye);
  double ball = around - 0.152;
  // A drilled pupil, as Roman sculptors cut it, a little above the middle.
  ball = carve(ball, sphere(m, {0.235, 0.135, 0.715}, 0.032), 0.01);
  const double upper_edge = eye.y + 0.045 - 0.35 * std::abs(m.x - eye.x);
  const double upper = std::max(around - 0.180, upper_edge - m.y);
  const double lower_edge = eye.y - 0.065 + 0.25 * std::abs(m.x - eye.x);
  const double lower = std::max(around - 0.172, m.y - lower_edge);
  return join(join(d, ball, 0.015), std::min(upper, lower), 0.012);
}

double add_nose(double d, Vec3 m) {
  double nose = tapered_capsule(m, {0, 0.24, 0.69}, {0, -0.17, 0.90}, 0.062, 0.088);
  nose = join(nose, ellipsoid(m, {0, -0.19, 0.90}, {0.088, 0.075, 0.085}), 0.04);
  nose = join(nose, ellipsoid(m, {0.095, -0.205, 0.80}, {0.062, 0.062, 0.085}), 0.04);
  nose = carve(nose, ellipsoid(m, {0.052, -0.275, 0.85}, {0.028, 0.03, 0.04}), 0.02);
  return join(d, nose, 0.06);
}

double add_mouth(double d, Vec3 m) {
  d = join(d, ellipsoid(m, {0, -0.45, 0.60}, {0.24, 0.16, 0.17}), 0.10);
  d = join(d, tapered_capsule(m, {0.02, -0.405, 0.765}, {0.17, -0.445, 0.69}, 0.042, 0.02), 0.02);
  d = join(d, tapered_capsule(m, {0, -0.505, 0.755}, {0.13, -0.475, 0.70}, 0.052, 0.025), 0.02);
  return carve(d, tapered_capsule(m, {0, -0.452, 0.815}, {0.17, -0.458, 0.735}, 0.022, 0.012),
               0.015);
}

}  // namespace

double face_distance(Vec3 p) {
  const Vec3 m{std::abs(p.x), p.y, p.z};
  const double d = skull(m);
  // The features are small; elsewhere the skull is all there is.
  if (std::abs(d) > 0.4 || p.z < 0.1) return d;
  return add_mouth(add_nose(add_eye(add_brow(d, m), m), m), m);
}

}  // namespace facet::generate
