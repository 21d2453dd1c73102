#version 450
// Functions of numbers, for `facet extremes`: elementary ones, and those that models are made of.
#extension GL_GOOGLE_include_directive : require
#include "../lib/beckmann.glsl"
#include "../lib/choice.glsl"
#include "../lib/fresnel.glsl"
#include "../lib/ggx.glsl"
#include "../lib/seen_triangle.glsl"
#include "../lib/triangle.glsl"
#include "../lib/warp.glsl"
#include "../shared/bindings.h"
#include "../shared/extreme_inputs.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(constant_id = 0) const uint FUNCTION = 0u;
layout(push_constant) uniform Range {
  uint first;
  uint stride;
  uint count;
}
range;
layout(std430, binding = 0) writeonly buffer Results { uint results[]; };

float elementary(uint index) {
  float x = uintBitsToFloat(index);
  if (FUNCTION == FUNCTION_EXP) return exp_accurate(x);
  if (FUNCTION == FUNCTION_LOG) return log_accurate(x);
  if (FUNCTION == FUNCTION_SINE) return sincos_turns(x).x;
  if (FUNCTION == FUNCTION_COSINE) return sincos_turns(x).y;
  if (FUNCTION == FUNCTION_ATAN) return atan2_accurate(x, 1.0);
  if (FUNCTION == FUNCTION_ERFC) return erfc_accurate(x);
  if (FUNCTION == FUNCTION_ERFINV) return erfinv_quantile(x);
  vec2 numbers = uintBitsToFloat(edge_numbers(index).xy);
  return atan2_accurate(numbers.x, numbers.y);
}

float of_model(uint index) {
  vec4 n = model_numbers(index);
  vec2 ab = n.xy;
  vec3 w = vec3(n.x, 0.0, n.y);
  if (FUNCTION == FUNCTION_FRESNEL_DIELECTRIC) return fresnel_dielectric(n.x, 1.0, n.w);
  if (FUNCTION == FUNCTION_FRESNEL_TRANSMITTANCE) return fresnel_shares(n.x, 1.0, n.w).transmitted;
  if (FUNCTION == FUNCTION_FRESNEL_SCHLICK) return fresnel_schlick(vec3(n.y), n.x).x;
  if (FUNCTION == FUNCTION_FRESNEL_CONDUCTOR)
    return fresnel_conductor(vec3(n.w), vec3(1000.0 * n.y * n.y), n.x).x;
  if (FUNCTION == FUNCTION_BECKMANN_D) return beckmann_d(w, n.z);
  if (FUNCTION == FUNCTION_GGX_D) return ggx_d(w, n.z);
  if (FUNCTION == FUNCTION_BECKMANN_G1_RATIONAL) return beckmann_g1_rational(w, n.z);
  if (FUNCTION == FUNCTION_BECKMANN_G1_EXACT) return beckmann_g1_exact(w, n.z);
  if (FUNCTION == FUNCTION_GGX_G1) return ggx_g1(w, n.z);
  if (FUNCTION == FUNCTION_VISIBLE_SLOPE) {
    vec2 c = max(ab, vec2(1.0e-7, 2.98023224e-8));
    return beckmann_visible_slope(sqrt((1.0 - c.x) * (1.0 + c.x)), c.x, c.y);
  }
  if (FUNCTION == FUNCTION_COSINE_HEMISPHERE_X) return square_to_cosine_hemisphere(ab).x;
  if (FUNCTION == FUNCTION_COSINE_HEMISPHERE_Y) return square_to_cosine_hemisphere(ab).y;
  if (FUNCTION == FUNCTION_COSINE_HEMISPHERE_Z) return square_to_cosine_hemisphere(ab).z;
  return FUNCTION == FUNCTION_TRIANGLE_U ? square_to_triangle(ab).x : square_to_triangle(ab).y;
}

/// What rounding has used up of the offset with which a ray leaves a triangle, as the test against
/// it sees it; 2 where the ray meets the triangle again.
float offset_used(uint index) {
  vec3 v0 = extreme_corner(index, 0u);
  vec3 v1 = extreme_corner(index, 1u);
  vec3 v2 = extreme_corner(index, 2u);
  vec4 numbers = leaving_numbers(index);
  vec3 ng = triangle_normal(v0, v1, v2);
  vec2 turn = sincos_turns(numbers.w);
  float sine = sqrt((1.0 - numbers.z) * (1.0 + numbers.z));
  vec3 d = to_world(frame_from_normal(ng), vec3(sine * turn.y, sine * turn.x, numbers.z));
  // As surface_at (lib/surface.glsl), whose code would grow by calls.
  float b0 = (1.0 - numbers.x) - numbers.y;
  vec3 p = (b0 * v0 + numbers.x * v1) + numbers.y * v2;
  vec3 largest = max(abs(v0), max(abs(v1), abs(v2)));
  float magnitude = max(largest.x, max(largest.y, largest.z));
  vec3 from = offset_ray_origin(p, magnitude, ng, d);
  TraversalRay ray = traversal_ray(RayRecord(vec4(from, 0.0), vec4(d, LARGEST)));
  if (intersect_pair(ray, Corners(v0, v1, v2, v2), LARGEST).found) return 2.0;
  vec3 e = v2 - v0;
  vec3 n = normalize_safe(plane_normal(e, e * (1.0 / dot3(e, e)), v1 - v0));
  float offset = abs(dot3(n, offset_ray_origin(vec3(0.0), magnitude, ng, d)));
  return 1.0 - abs(dot3(n, from - v0)) / offset;
}

float of_seen(uint index) {
  SeenTriangle t = see_corners(extreme_corner(index, 0u), extreme_corner(index, 1u),
                               extreme_corner(index, 2u), extreme_viewer(index));
  if (FUNCTION == FUNCTION_SEEN_SOLID_ANGLE) return t.solid_angle;
  vec2 b = seen_point(t, leaving_numbers(index).xy);
  return FUNCTION == FUNCTION_SEEN_POINT_B1 ? b.x : b.y;
}

uint of_words(uint index) {
  uvec4 q = wide_quotient(index);
  return divide_wide(q.x, q.y, q.z);
}

uint of_index(uint index) {
  if (FUNCTION == FUNCTION_QUOTIENT) return of_words(index);
  if (FUNCTION == FUNCTION_OFFSET_USED) return floatBitsToUint(offset_used(index));
  if (FUNCTION >= FUNCTION_SEEN_SOLID_ANGLE) return floatBitsToUint(of_seen(index));
  if (FUNCTION >= FUNCTION_FRESNEL_DIELECTRIC) return floatBitsToUint(of_model(index));
  return floatBitsToUint(elementary(index));
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= range.count) return;
  results[i] = of_index(range.first + i * range.stride);
}
