#pragma once
// Small maths over GLM: boxes, colours, transforms of points and normals.
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace facet {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

/// Stands for no index.
inline constexpr std::uint32_t none = 0xffffffffU;

/// Linear colour, Rec. 709 primaries.
using Color = glm::vec3;

/// Relative luminance of a linear Rec. 709 colour.
template <typename T>
T luminance(const glm::vec<3, T>& c) {
  return T(0.2126) * c.r + T(0.7152) * c.g + T(0.0722) * c.b;
}

/// Axis-aligned box; empty until something is added.
struct Box {
  vec3 lower{std::numeric_limits<float>::infinity()};
  vec3 upper{-std::numeric_limits<float>::infinity()};

  void add(const vec3& p) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  void add(const Box& b) {
    lower = glm::min(lower, b.lower);
    upper = glm::max(upper, b.upper);
  }
  [[nodiscard]] bool empty() const { return lower.x > upper.x; }
  [[nodiscard]] vec3 extent() const { return upper - lower; }
  /// Half the surface area; 0 when empty.
  [[nodiscard]] float half_area() const {
    if (empty()) return 0;
    const vec3 e = extent();
    return e.x * e.y + e.y * e.z + e.z * e.x;
  }
};

}  // namespace facet
