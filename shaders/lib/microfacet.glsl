// A rough surface: which distribution of microfacets it has, and how it is sampled and masked.
// Directions are in the shading frame, on the upper side.
#ifndef FACET_MICROFACET_GLSL
#define FACET_MICROFACET_GLSL
#include "beckmann.glsl"
#include "parameters.glsl"
#include "ggx.glsl"
#include "specialization.glsl"

struct Microfacets {
  float alpha;
  uint flags;  // BSDF_GGX, BSDF_EXACT_MASKING
};

Microfacets microfacets_of(BsdfRecord b) { return Microfacets(bsdf_roughness(b), b.flags); }

/// Density D of a half vector of any length, sr^-1.
float microfacet_d(vec3 h, Microfacets m) {
  if (HAS_FLAG(m.flags, BSDF_GGX)) return ggx_d(h, m.alpha);
  return beckmann_d(h, m.alpha);
}

/// What normalises the visible normals of direction w.
float microfacet_normalisation(vec3 w, Microfacets m) {
  if (HAS_FLAG(m.flags, BSDF_GGX)) return ggx_g1(w, m.alpha);
  return beckmann_g1_exact(w, m.alpha);
}

/// Masking G1 of direction w, whose microfacet it sees from the front.
float microfacet_g1(vec3 w, Microfacets m) {
  if (HAS_FLAG(m.flags, BSDF_GGX)) return ggx_g1(w, m.alpha);
  if (HAS_FLAG(m.flags, BSDF_EXACT_MASKING)) return beckmann_g1_exact(w, m.alpha);
  return beckmann_g1_rational(w, m.alpha);
}

/// Separable Smith masking-shadowing.
float microfacet_g(vec3 wi, vec3 wo, Microfacets m) {
  return microfacet_g1(wi, m) * microfacet_g1(wo, m);
}

/// Unit half vector by the chosen strategy.
vec3 microfacet_sample_half_vector(vec3 wo, Microfacets m, vec2 u) {
  if (HAS_FLAG(m.flags, BSDF_GGX)) {
    if (VISIBLE_NORMALS) return ggx_sample_visible(wo, m.alpha, u);
    return ggx_sample_ndf(m.alpha, u);
  }
  if (VISIBLE_NORMALS) return beckmann_sample_visible(wo, m.alpha, u);
  return beckmann_sample_ndf(m.alpha, u);
}

/// Density of the half vector over 4 wo.h, that of the reflected direction, sr^-1, for h of any
/// length; o_dot_h = dot(wo, h).
float microfacet_pdf(vec3 h, float o_dot_h, vec3 wo, Microfacets m) {
  float d = microfacet_d(h, m);
  if (VISIBLE_NORMALS) return d * 0.25 * microfacet_normalisation(wo, m) / wo.z;
  return o_dot_h > 0.0 ? d * 0.25 * h.z / o_dot_h : 0.0;  // both cosines carry the length of h
}

/// G D / (4 cos_i cos_o) * cos_i over that density, with D cancelled by hand, for the unit half
/// vector wh, c = dot(wo, wh) > 0.
float microfacet_weight(vec3 wh, float c, vec3 wo, vec3 wi, Microfacets m) {
  float g_i = microfacet_g1(wi, m);
  float g_o = microfacet_g1(wo, m);
  if (VISIBLE_NORMALS) return g_i * (g_o / microfacet_normalisation(wo, m));
  return g_i * (g_o / wo.z) * (c / wh.z);
}

/// A pair of directions on the same side and what follows from it.
struct MicrofacetPair {
  vec3 h;         // wo + wi, not normalised: each component is exact to half an ulp
  float o_dot_h;  // dot(wo, h) = |h|^2 / 2 for unit vectors, which does not cancel
  float cos_h;    // cosine between either direction and h: |h| / 2
};

MicrofacetPair microfacet_pair(vec3 wo, vec3 wi) {
  MicrofacetPair p;
  p.h = wo + wi;
  float h2 = dot3(p.h, p.h);
  p.o_dot_h = 0.5 * h2;
  p.cos_h = min(0.5 * sqrt(h2), 1.0);
  return p;
}

#endif
