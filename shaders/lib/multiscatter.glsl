// What light loses between microfacets, given back: E. Turquin, "Practical multiple scattering
// compensation for microfacet models", 2019. The value is multiplied by 1 + F0 (1 - E)/E, E being
// the albedo with F = 1 from tables made by the build. With F = 1 nothing is lost; the value is no
// longer reciprocal.
#ifndef FACET_MULTISCATTER_GLSL
#define FACET_MULTISCATTER_GLSL
#include "microfacet.glsl"
#include "records.glsl"

float albedo_node(uint table, uint column, uint row) {
  return fetch_albedo((table * ALBEDO_NODES + row) * ALBEDO_NODES + column);
}

/// Albedo with F = 1 seen under a cosine, bilinear between the tables' nodes.
float microfacet_albedo(float cosine, Microfacets m) {
  uint table =
      HAS_FLAG(m.flags, BSDF_EXACT_MASKING) ? ALBEDO_BECKMANN_EXACT : ALBEDO_BECKMANN_RATIONAL;
  table = HAS_FLAG(m.flags, BSDF_GGX) ? ALBEDO_GGX : table;
  // From behind it is asked for too, and not used.
  float c = max(cosine, 0.0);
  vec2 at = vec2(c * (1.0 + m.alpha) / (c + m.alpha), sqrt(m.alpha)) * 31.0;  // nodes - 1
  vec2 base = min(floor(at), vec2(30.0));
  vec2 f = at - base;
  uint x = uint(base.x);
  uint y = uint(base.y);
  float lower = lerp(albedo_node(table, x, y), albedo_node(table, x + 1u, y), f.x);
  float upper = lerp(albedo_node(table, x, y + 1u), albedo_node(table, x + 1u, y + 1u), f.x);
  return lerp(lower, upper, f.y);
}

/// Factor on the value of a lobe of reflectance f0 at normal incidence, seen under a cosine.
vec3 multiscatter_factor(vec3 f0, float cosine, Microfacets m) {
  float e = microfacet_albedo(cosine, m);
  return vec3(1.0) + f0 * ((1.0 - e) / e);
}

#endif
