#pragma once
// Four floats in a vector register, and boxes made of them. For inner loops over very many boxes;
// all else takes Box.
#include "core/maths.h"

namespace facet {

/// Arithmetic and comparisons go lane by lane (a language extension of GCC and Clang, on every
/// processor).
using Float4 [[gnu::vector_size(16)]] = float;

inline Float4 min(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float4 to_float4(const vec3& v) { return Float4{v.x, v.y, v.z, 0}; }
inline vec3 to_vec3(Float4 v) { return {v[0], v[1], v[2]}; }

/// Axis-aligned box in the first three lanes. Not empty by itself, so that arrays of them cost
/// nothing to make.
struct Box4 {
  Float4 lower;
  Float4 upper;

  void add(const Float4& p) {
    lower = min(lower, p);
    upper = max(upper, p);
  }
  void add(const Box4& b) {
    lower = min(lower, b.lower);
    upper = max(upper, b.upper);
  }
  /// Half the surface area; not of an empty box.
  [[nodiscard]] float half_area() const {
    const Float4 e = upper - lower;
    return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
  }
  [[nodiscard]] Box box() const { return {to_vec3(lower), to_vec3(upper)}; }
};

inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr Box4 empty_box4{{infinity, infinity, infinity, infinity},
                                 {-infinity, -infinity, -infinity, -infinity}};

}  // namespace facet
