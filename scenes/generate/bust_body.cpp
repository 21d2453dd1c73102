#include <numbers>

#include "bust_parts.h"
#include "distance.h"
#include "noise.h"

namespace facet::generate {
namespace {

/// A fold's profile over its phase in radians: broad rounded ridges, narrow valleys; in [0, 1].
double fold_profile(double phase) { return std::sqrt(std::pow(std::cos(0.5 * phase), 2) + 0.02); }

double torso(Vec3 p) {
  const Vec3 m{std::abs(p.x), p.y, p.z};
  double d = ellipsoid(m, {0, -2.15, -0.22}, {1.05, 0.85, 0.58});
  d = join(d, ellipsoid(m, {0.82, -1.98, -0.25}, {0.50, 0.46, 0.44}), 0.25);
  d = join(d, tapered_capsule(m, {0, -1.35, -0.26}, {0.75, -1.70, -0.25}, 0.36, 0.33), 0.30);
  d = join(d, ellipsoid(m, {0.42, -2.22, 0.12}, {0.46, 0.38, 0.32}), 0.22);
  // The bust's lower edge is an arc, as Roman busts are cut, and its back is hollow.
  d = std::max(d, sphere(p, {0, -1.35, -0.15}, 1.62));
  return carve(d, ellipsoid(p, {0, -2.35, -0.85}, {0.85, 0.75, 0.45}), 0.06);
}

double chiton(Vec3 p, double body) {
  // Folds hang in arcs from shoulder to shoulder and crowd towards the neck.
  const double wobble = 0.10 * value_noise({2.3 * p.x, 1.7 * p.y, 2.3 * p.z});
  const double depth = -1.30 - p.y + 0.62 * p.x * p.x + 0.12 * p.x + wobble;
  const double phase = 2.0 * std::numbers::pi * depth / 0.20;
  // No two folds are of one height, and none keeps its height all the way.
  const double uneven = 0.65 + 0.5 * value_noise({1.9 * p.x + 7.0, 6.0 * depth, 1.5 * p.z});
  const double front = smooth_step(-0.35, 0.15, p.z);
  const double strength = 0.07 * uneven * (0.45 + 0.55 * front) * smooth_step(0.0, 0.25, depth);
  return body - 0.02 - strength * fold_profile(phase);
}

double mantle(Vec3 p, double body) {
  // A heavy roll over the left shoulder and a sheet below it, folds running down the arm.
  const double edge =
      p.x - 0.52 - 0.20 * (p.y + 1.6) + 0.04 * value_noise({2.5 * p.x, 2.5 * p.y, 2.5 * p.z});
  const double sway = 0.12 * value_noise({1.5 * p.x, 1.9 * p.y, 1.8 * p.z});
  const double phase =
      2.0 * std::numbers::pi * (p.x + 0.25 * p.z - 0.30 * (p.y + 1.6) * (p.y + 1.6) + sway) / 0.21;
  const double uneven = 0.6 + 0.5 * value_noise({5.0 * p.x, 2.0 * p.y, 2.0 * p.z + 5.0});
  const double sheet = std::max(body - 0.07 - 0.07 * uneven * fold_profile(phase), -edge);
  double roll = tapered_capsule(p, {0.55, -1.38, -0.42}, {0.56, -1.52, 0.12}, 0.14, 0.15);
  roll = join(roll, tapered_capsule(p, {0.56, -1.52, 0.12}, {0.34, -2.55, 0.32}, 0.15, 0.12), 0.08);
  const double twist = 2.0 * std::numbers::pi * (p.x - 0.55 + 0.8 * p.z + 0.28 * p.y) / 0.13;
  return join(sheet, roll - 0.03 * fold_profile(twist), 0.05);
}

}  // namespace

double drapery_distance(Vec3 p) {
  const double body = torso(p);
  if (body > 0.6) return body - 0.3;
  const double cut = sphere(p, {0, -1.35, -0.15}, 1.66);
  return std::max(join(chiton(p, body), mantle(p, body), 0.04), cut);
}

double kalathos_distance(Vec3 p) {
  constexpr double bottom = 0.92;
  constexpr double top = 1.78;
  const Vec3 q{p.x, p.y, p.z + 0.14};
  const double t = std::clamp((q.y - bottom) / (top - bottom), 0.0, 1.0);
  const double radius = 0.42 + 0.10 * t + 0.05 * t * t * t;
  // Olive leaves in relief around it, in two rows of lozenges that lean against each other.
  const double around = std::atan2(q.x, q.z) * 12.0 / (2.0 * std::numbers::pi);
  const double up = t * 3.0;
  const double lean = std::fmod(std::floor(up), 2.0) < 0.5 ? 0.35 : -0.35;
  const double along = up - std::floor(up) - 0.5;
  const double across = around + lean * along - std::round(around + lean * along);
  const double leaf = 1.0 - std::hypot(across * 2.5, along * 2.2);
  const double relief = 0.035 * smooth_step(0.0, 0.5, leaf) -
                        0.014 * (1.0 - smooth_step(0.0, 0.06, std::abs(across)));
  const double wall = 0.96 * (std::hypot(q.x, q.z) - radius - relief);
  double d = std::max(wall, std::abs(q.y - 0.5 * (bottom + top)) - 0.5 * (top - bottom));
  d = join(d, ring(q, {0, bottom + 0.05, 0}, 0.44, 0.055), 0.02);
  d = join(d, ring(q, {0, top - 0.04, 0}, 0.57, 0.05), 0.02);
  return carve(d, cylinder(q, {0, top - 0.12, 0}, top + 0.5, 0.47, 0.03), 0.02);
}

double socle_distance(Vec3 p) {
  const Vec3 q{p.x, p.y, p.z + 0.12};
  double d = cylinder(q, {0, socle_bottom, 0}, socle_bottom + 0.14, 0.58, 0.02);
  d = join(d, ring(q, {0, socle_bottom + 0.19, 0}, 0.46, 0.075), 0.015);
  const double height = q.y - (socle_bottom + 0.45);
  const double waist = 0.27 + 0.75 * height * height;
  const double shaft = std::max(0.85 * (std::hypot(q.x, q.z) - waist), std::abs(height) - 0.42);
  d = join(d, shaft, 0.03);
  return join(d, ring(q, {0, socle_bottom + 0.84, 0}, 0.36, 0.06), 0.02);
}

}  // namespace facet::generate
