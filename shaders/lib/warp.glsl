// Maps from the unit square to directions and points (docs/reference/sampling.md, "Maps").
#ifndef FACET_WARP_GLSL
#define FACET_WARP_GLSL
#include "elementary.glsl"

/// Direction on the upper hemisphere, density cos(theta)/pi.
vec3 square_to_cosine_hemisphere(vec2 u) {
  float r = sqrt(u.x);
  vec2 sc = sincos_turns(u.y);
  return vec3(r * sc.y, r * sc.x, sqrt(1.0 - u.x));
}

/// Barycentric weights of v1 and v2, uniform over a triangle.
vec2 square_to_triangle(vec2 u) {
  float s = sqrt(1.0 - u.x);
  return vec2(s * (1.0 - u.y), s * u.y);
}

#endif
