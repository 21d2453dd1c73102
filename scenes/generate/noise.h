#pragma once

#include <cstdint>

#include "vec3.h"

namespace facet::generate {

/// A number in [0, 1) that depends on the index and the stream alone (PCG output hash).
inline double random_number(std::uint32_t index, std::uint32_t stream) {
  std::uint32_t state = (index * 747796405u + 2891336453u) ^ (stream * 2654435769u);
  state = state * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return static_cast<double>((word >> 22u) ^ word) * 0x1p-32;
}

/// Smooth value noise in [-1, 1] with features of about unit size.
inline double value_noise(Vec3 p) {
  const Vec3 cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const Vec3 t{smooth_step(0, 1, p.x - cell.x), smooth_step(0, 1, p.y - cell.y),
               smooth_step(0, 1, p.z - cell.z)};
  const auto corner = [&cell](int i, int j, int k) {
    const auto at = [](double c, int offset) {
      return static_cast<std::uint32_t>(static_cast<int>(c) + offset);
    };
    return random_number(at(cell.x, i) + 1013u * at(cell.y, j), at(cell.z, k));
  };
  const auto mix = [](double a, double b, double s) { return a + (b - a) * s; };
  double value[2] = {};
  for (int k = 0; k < 2; ++k) {
    value[k] = mix(mix(corner(0, 0, k), corner(1, 0, k), t.x),
                   mix(corner(0, 1, k), corner(1, 1, k), t.x), t.y);
  }
  return 2.0 * mix(value[0], value[1], t.z) - 1.0;
}

}  // namespace facet::generate
