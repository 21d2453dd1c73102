/* area: a mesh that emits from one side.

   Emits where ns.w > 0, ns being the interpolated normal; points are sampled uniformly by area, two
   neighbouring triangles of one area as one, and the density per solid angle is p d^2 / (A |ng.w|)
   with the geometric normal ng, p being the probability of the triangle and A its area. It must not
   lie in the plane of another surface that it overlaps: rounding decides which of the two a ray
   meets. */
#include "../lib/emitter_sample.glsl"
#include "../lib/choice.glsl"
#include "../lib/random.glsl"
#include "../lib/surface.glsl"
#include "../lib/texture.glsl"
#include "../lib/warp.glsl"

/// Radiance leaving surface s towards -d.
vec3 area_eval(EmitterRecord e, Surface s, vec3 d) {
  vec3 radiance = e.radiance.rgb;
  if (TEXTURE_KINDS != 0u) radiance = radiance * texture_value(e.texture, vec3(1.0), s.uv);
  return dot3(s.ns, d) < 0.0 ? radiance : vec3(0.0);
}

/// Density, sr^-1, of sampling the point of s at the given distance along d, once this emitter is
/// chosen. s lies on the emitter.
float area_pdf(EmitterRecord e, Surface s, vec3 d, float distance) {
  float c = abs(dot3(s.ng, d));
  float density = fetch_emitter_triangle(e.first_triangle + (s.index - e.first_index)).density;
  // Finite, so that the MIS weight of a vanishing emitter is no quotient of infinities.
  return c > 0.0 ? min((distance * density) * (distance / c), 1.0e37) : 0.0;
}

#define FACET_TRIANGLE_COUNT(i) fetch_emitter_triangle(i).cumulative
FACET_DEFINE_CHOICE(choose_emitter_triangle, FACET_TRIANGLE_COUNT)

/// A point of a triangle.
struct TrianglePoint {
  uint triangle;  // place in the BVH
  vec2 b;         // barycentric weights of its second and third vertex
};

/// The point (u, v) of two triangles that have an edge in common.
TrianglePoint point_of_two(EmitterTriangle first, EmitterTriangle second, vec2 u) {
  bool in_first = u.x + u.y <= 1.0;
  // Of the corner that the edge misses and, in winding order, of the others.
  vec3 weights =
      in_first ? vec3(1.0 - u.x - u.y, u.x, u.y) : vec3(u.x + u.y - 1.0, 1.0 - u.x, 1.0 - u.y);
  uint corner = in_first ? first.corner : second.corner;
  vec2 b = corner == 0u ? weights.yz : (corner == 1u ? weights.xy : weights.zx);
  return TrianglePoint(in_first ? first.triangle : second.triangle, b);
}

/// A point of the emitter; u, v: words, fill: that of u.
TrianglePoint area_point(EmitterRecord e, uint u, uint v, uint fill) {
  uint first = e.first_triangle;
  uint word = choice_word(u);
  uint chosen = choose_emitter_triangle(first, first + max(e.triangle_count, 1u) - 1u, word);
  EmitterTriangle triangle = fetch_emitter_triangle(chosen);
  EmitterTriangle before = fetch_emitter_triangle(chosen > first ? chosen - 1u : chosen);
  uint begin = chosen > first ? before.cumulative : 0u;
  u = remainder_word(word, begin, triangle.cumulative, fill);
  vec2 square = vec2(unit_float(u), unit_float(v));
  bool is_pair = EMITTER_PIECES == 2u || (EMITTER_PIECES == 3u && triangle.corner != NO_CORNER);
  if (is_pair) return point_of_two(before, triangle, square);
  return TrianglePoint(triangle.triangle, square_to_triangle(square));
}

/// from: the shaded surface; u, v: words, fill: that of u.
EmitterSample area_sample(EmitterRecord e, Surface from, uint u, uint v, uint fill) {
  TrianglePoint point = area_point(e, u, v, fill);
  Surface s = surface_at(point.triangle, point.b.x, point.b.y);
  vec3 to = s.position - from.position;
  EmitterSample r;
  r.d = normalize_safe(to);
  r.pdf = area_pdf(e, s, r.d, dot3(to, r.d));
  r.radiance = r.pdf > 0.0 ? area_eval(e, s, r.d) : vec3(0.0);
  // Both ends of the shadow ray are moved off their surfaces; this one must also cover the error of
  // a test from afar.
  r.point = offset_ray_origin(s.position, max(s.magnitude, from.magnitude), s.ng, -r.d);
  r.at_infinity = false;
  r.delta = false;
  return r;
}
