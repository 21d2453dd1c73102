/* roughsubstrate: a diffuse base under a rough dielectric coat (glossy paint, plastic).

   f = 28 kd/(23 pi) (1 - F0) (1 - (1 - cos_i/2)^5) (1 - (1 - cos_o/2)^5) + D F G/(4 cos_i cos_o):
   the diffuse term of Ashikhmin and Shirley 2000, whose albedo is kd (1 - F0) (1 - (1 -
   cos_o/2)^5), and a rough lobe with the exact dielectric Fresnel term. The lobe to sample is
   chosen by those albedos; the pdf is that of both together. */
#include "../lib/coated.glsl"
#include "../lib/fresnel.glsl"

/// Probability of choosing the coat.
float roughsubstrate_coat_probability(BsdfRecord b, vec3 wo) {
  float base = mean3(roughsubstrate_kd(b)) * (1.0 - roughsubstrate_f0(b)) * coated_falloff(wo.z);
  return coated_probability(
      fresnel_dielectric(wo.z, roughsubstrate_ext_ior(b), roughsubstrate_int_ior(b)), base);
}

/// Value of both lobes times cos_i, for the half vector h of any length; c: cosine between either
/// direction and h.
vec3 roughsubstrate_value(BsdfRecord b, vec3 wo, vec3 wi, vec3 h, float c) {
  Microfacets m = microfacets_of(b);
  // 28/(23 pi)
  vec3 base = roughsubstrate_kd(b) * (0.387507688 * (1.0 - roughsubstrate_f0(b)) *
                                      coated_falloff(wi.z) * coated_falloff(wo.z) * wi.z);
  float coat = microfacet_d(h, m) * 0.25 *
               fresnel_dielectric(c, roughsubstrate_ext_ior(b), roughsubstrate_int_ior(b)) *
               microfacet_g(wi, wo, m) / wo.z;
  return base + vec3(coat);
}

vec3 roughsubstrate_eval(BsdfRecord b, vec3 wo, vec3 wi) {
  MicrofacetPair p = microfacet_pair(wo, wi);
  return roughsubstrate_value(b, wo, wi, p.h, p.cos_h) / wi.z;
}

float roughsubstrate_pdf(BsdfRecord b, vec3 wo, vec3 wi) {
  MicrofacetPair p = microfacet_pair(wo, wi);
  return coated_pdf(p.h, p.o_dot_h, wo, wi.z, microfacets_of(b),
                    roughsubstrate_coat_probability(b, wo));
}

BsdfSample roughsubstrate_sample(BsdfRecord b, vec3 wo, BsdfNumbers n) {
  Microfacets m = microfacets_of(b);
  float p = roughsubstrate_coat_probability(b, wo);
  CoatedDirection d = coated_sample(wo, m, p, n);
  return coated_result(d, wo, m, p, roughsubstrate_value(b, wo, d.wi, d.h, d.cos_h));
}
