#pragma once

#include <cstdint>
#include <numbers>

#include "curls.h"
#include "noise.h"

namespace facet::generate {

template <typename Keep>
std::vector<Curls::Curl> scatter_curls(Vec3 centre, Vec3 axes, std::size_t count, double radius,
                                       const Keep& keep) {
  constexpr double golden_angle = 2.399963229728653;
  std::vector<Curls::Curl> curls;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double disorder = random_number(i, 1) - 0.5;
    const double y = 1.0 - 2.0 * (i + 0.5) / static_cast<double>(count);
    const double phi = golden_angle * i + 0.25 * disorder;
    const double ring_radius = std::sqrt(1.0 - y * y);
    const Vec3 unit{ring_radius * std::sin(phi), y, ring_radius * std::cos(phi)};
    const Vec3 point = centre + Vec3{unit.x * axes.x, unit.y * axes.y, unit.z * axes.z};
    if (!keep(point)) continue;
    const Vec3 outward = normalize({unit.x / axes.x, unit.y / axes.y, unit.z / axes.z});
    const double size = radius * (0.85 + 0.35 * random_number(i, 2));
    const double turn = 2.0 * std::numbers::pi * random_number(i, 3);
    curls.push_back({point, outward, size, turn, random_number(i, 4) < 0.5 ? -1.0 : 1.0});
  }
  return curls;
}

}  // namespace facet::generate
