/* fresnelblend: a diffuse base that a glossy coat dims, PBRT's FresnelBlend.

   f = 28 Rd/(23 pi) (1 - Rs) (1 - (1 - cos_i/2)^5) (1 - (1 - cos_o/2)^5)
   + D Schlick(Rs, wi.wh)/(4 wi.wh max(cos_i, cos_o)): M. Ashikhmin, P. Shirley, "An Anisotropic
   Phong BRDF Model", 2000, with a microfacet distribution for theirs. It has no masking. */
#include "../lib/coated.glsl"
#include "../lib/fresnel.glsl"

/// Probability of choosing the coat.
float fresnelblend_coat_probability(BsdfRecord b, vec3 wo) {
  float base = mean3(fresnelblend_rd(b) * (vec3(1.0) - fresnelblend_rs(b))) * coated_falloff(wo.z);
  return coated_probability(mean3(fresnel_schlick(fresnelblend_rs(b), wo.z)), base);
}

/// Value of both lobes times cos_i, for the half vector h of any length; c: cosine between either
/// direction and h.
vec3 fresnelblend_value(BsdfRecord b, vec3 wo, vec3 wi, vec3 h, float c) {
  Microfacets m = microfacets_of(b);
  // 28/(23 pi)
  float falloff = 0.387507688 * coated_falloff(wi.z) * coated_falloff(wo.z) * wi.z;
  vec3 base = fresnelblend_rd(b) * (vec3(1.0) - fresnelblend_rs(b)) * falloff;
  float coat = microfacet_d(h, m) * 0.25 / c * (wi.z / max(wi.z, wo.z));
  return base + fresnel_schlick(fresnelblend_rs(b), c) * coat;
}

vec3 fresnelblend_eval(BsdfRecord b, vec3 wo, vec3 wi) {
  MicrofacetPair p = microfacet_pair(wo, wi);
  return fresnelblend_value(b, wo, wi, p.h, p.cos_h) / wi.z;
}

float fresnelblend_pdf(BsdfRecord b, vec3 wo, vec3 wi) {
  MicrofacetPair p = microfacet_pair(wo, wi);
  return coated_pdf(p.h, p.o_dot_h, wo, wi.z, microfacets_of(b),
                    fresnelblend_coat_probability(b, wo));
}

BsdfSample fresnelblend_sample(BsdfRecord b, vec3 wo, BsdfNumbers n) {
  Microfacets m = microfacets_of(b);
  float p = fresnelblend_coat_probability(b, wo);
  CoatedDirection d = coated_sample(wo, m, p, n);
  return coated_result(d, wo, m, p, fresnelblend_value(b, wo, d.wi, d.h, d.cos_h));
}
