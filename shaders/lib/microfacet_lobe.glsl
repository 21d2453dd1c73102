// The reflection lobe that rough BSDFs share: everything but the Fresnel term, under either way of sampling.
#ifndef FACET_MICROFACET_LOBE_GLSL
#define FACET_MICROFACET_LOBE_GLSL
#include "microfacet.glsl"
#include "specialization.glsl"

/// A pair of directions and what follows from it.
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

/// D G / (4 cos_i cos_o), sr^-1.
float microfacet_eval(MicrofacetPair p, vec3 wo, vec3 wi, float alpha) {
  float g = beckmann_g(wi, wo, p.cos_h, p.cos_h, alpha);
  return beckmann_d(p.h, alpha) * 0.25 * (g / wi.z) / wo.z;
}

/// Density of the reflected direction, sr^-1, for the half vector h of any length; o_dot_h = dot(wo, h).
float microfacet_pdf(vec3 h, float o_dot_h, vec3 wo, float alpha) {
  float d = beckmann_d(h, alpha);
  if (VISIBLE_NORMALS) return d * 0.25 * beckmann_g1_exact(wo, alpha) / wo.z;
  return o_dot_h > 0.0 ? d * 0.25 * h.z / o_dot_h : 0.0;  // both cosines carry the length of h
}

/// Unit half vector by the chosen strategy.
vec3 microfacet_sample_half_vector(vec3 wo, float alpha, vec2 u) {
  if (VISIBLE_NORMALS) return beckmann_sample_visible(wo, alpha, u);
  return beckmann_sample_ndf(alpha, u);
}

/// D G / (4 cos_i cos_o) * cos_i / pdf with D cancelled by hand; 0 below the horizon.
float microfacet_weight(vec3 wh, vec3 wo, vec3 wi, float alpha) {
  float c = dot3(wo, wh);
  float g_i = beckmann_g1_rational(wi, c, alpha);
  float g_o = beckmann_g1_rational(wo, c, alpha);
  bool valid = wi.z > 0.0 && c > 0.0;
  if (VISIBLE_NORMALS) return valid ? g_i * (g_o / beckmann_g1_exact(wo, alpha)) : 0.0;
  return valid ? g_i * (g_o / wo.z) * (c / wh.z) : 0.0;
}

#endif
