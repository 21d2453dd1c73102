// Two lobes: a coat of microfacets over a diffuse base. What the BSDFs that are made so have in
// common.
#ifndef FACET_COATED_GLSL
#define FACET_COATED_GLSL
#include "bsdf_sample.glsl"
#include "constants.glsl"
#include "microfacet.glsl"
#include "warp.glsl"

float mean3(vec3 c) { return (c.r + c.g + c.b) * 0.333333333; }

/// 1 - (1 - c/2)^5, without cancellation for small c: x (5 - 10 x + 10 x^2 - 5 x^3 + x^4), x = c/2.
/// M. Ashikhmin, P. Shirley, "An Anisotropic Phong BRDF Model", 2000.
float coated_falloff(float c) {
  float x = 0.5 * c;
  return x * (5.0 + x * (-10.0 + x * (10.0 + x * (-5.0 + x))));
}

/// Probability of choosing the coat, by estimates of both albedos, in whole words; neither lobe
/// that has a value is out of reach.
float coated_probability(float coat, float base) {
  float p = min(max(coat / (coat + base), 5.96046448e-8), base > 0.0 ? 0.99999994 : 1.0);
  return coat > 0.0 ? whole_words(p) : 0.0;
}

/// Density of wi under both lobes, sr^-1; h of any length.
float coated_pdf(vec3 h, float o_dot_h, vec3 wo, float wi_z, Microfacets m, float p) {
  return p * microfacet_pdf(h, o_dot_h, wo, m) + (1.0 - p) * wi_z * INV_PI;
}

/// A direction from either lobe, and its half vector.
struct CoatedDirection {
  vec3 wi;
  vec3 h;
  float o_dot_h;
  float cos_h;  // cosine between either direction and h
};

CoatedDirection coated_sample(vec3 wo, Microfacets m, float p, BsdfNumbers n) {
  bool coat = choose_first_lobe(n, p);
  vec2 u = square_of(n);
  vec3 wh = microfacet_sample_half_vector(wo, m, u);
  float c = dot3(wo, wh);
  CoatedDirection d;
  d.wi = coat ? 2.0 * c * wh - wo : square_to_cosine_hemisphere(u);
  // The coat's own half vector is more exact than the one found again from the two directions.
  MicrofacetPair pair = microfacet_pair(wo, d.wi);
  d.h = coat ? wh : pair.h;
  d.o_dot_h = coat ? c : pair.o_dot_h;
  d.cos_h = coat ? c : pair.cos_h;
  return d;
}

/// The sample whose whole value times cos_i is given.
BsdfSample coated_result(CoatedDirection d, vec3 wo, Microfacets m, float p,
                         vec3 value_times_cosine) {
  BsdfSample s = bsdf_sample_none();
  s.wi = d.wi;
  s.pdf = coated_pdf(d.h, d.o_dot_h, wo, d.wi.z, m, p);
  bool valid = d.wi.z > 0.0 && d.cos_h > 0.0 && s.pdf > 0.0;
  s.weight = valid ? value_times_cosine / s.pdf : vec3(0.0);
  return s;
}

#endif
