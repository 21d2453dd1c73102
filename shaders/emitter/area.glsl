/* area: a mesh that emits from one side.

   Emits where ns.w > 0, ns being the interpolated normal; points are sampled uniformly by area, and
   the density per solid angle is p d^2 / (A |ng.w|) with the geometric normal ng, p being the
   probability of the triangle and A its area. It must not lie in the plane of another surface that
   it overlaps: rounding decides which of the two a ray meets. */
#include "../lib/emitter_sample.glsl"
#include "../lib/choice.glsl"
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

/// from: the shaded surface.
EmitterSample area_sample(EmitterRecord e, Surface from, uint primitive_bits, vec2 u) {
  vec2 b = square_to_triangle(u);
  uint last = e.first_triangle + max(e.triangle_count, 1u) - 1u;
  uint chosen = choose_emitter_triangle(e.first_triangle, last, choice_word(primitive_bits));
  Surface s = surface_at(fetch_emitter_triangle(chosen).triangle, b.x, b.y);
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
