#pragma once
// Light from polygons.
#include <array>
#include <cmath>

#include "core/maths.h"

namespace facet::test {

/// Irradiance of a horizontal plane at the origin from a triangle of radiance 1 (J. H. Lambert
/// 1760), counting its front side.
[[nodiscard]] inline double polygon_irradiance(const std::array<dvec3, 3>& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec3 a = glm::normalize(polygon.at(i));
    const dvec3 b = glm::normalize(polygon.at((i + 1) % 3));
    const dvec3 normal = glm::cross(a, b);
    sum += std::atan2(glm::length(normal), glm::dot(a, b)) * glm::normalize(normal).y;
  }
  return sum / 2;
}

}  // namespace facet::test
