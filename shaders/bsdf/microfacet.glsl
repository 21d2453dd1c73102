/* microfacet: Nori's rough plastic: a Lambertian base and a rough dielectric coat that share the
   light by the base's albedo.

   f = kd/pi + ks D F G/(4 cos_i cos_o), ks = 1 - max(kd), F dielectric. */
#include "../lib/coated.glsl"
#include "../lib/fresnel.glsl"

/// Probability of choosing the coat.
float microfacet_coat_probability(BsdfRecord b, vec3 wo) {
  float ks = 1.0 - max(microfacet_kd(b).r, max(microfacet_kd(b).g, microfacet_kd(b).b));
  return coated_probability(
      ks * fresnel_dielectric(wo.z, microfacet_ext_ior(b), microfacet_int_ior(b)),
      mean3(microfacet_kd(b)));
}

/// Value of both lobes times cos_i, for the half vector h of any length; c: cosine between either
/// direction and h.
vec3 microfacet_value(BsdfRecord b, vec3 wo, vec3 wi, vec3 h, float c) {
  Microfacets m = microfacets_of(b);
  vec3 base = microfacet_kd(b) * (INV_PI * wi.z);
  float ks = 1.0 - max(microfacet_kd(b).r, max(microfacet_kd(b).g, microfacet_kd(b).b));
  float coat = microfacet_d(h, m) * 0.25 *
               fresnel_dielectric(c, microfacet_ext_ior(b), microfacet_int_ior(b)) *
               microfacet_g(wi, wo, m) / wo.z;
  return base + vec3(ks * coat);
}

vec3 microfacet_eval(BsdfRecord b, vec3 wo, vec3 wi) {
  MicrofacetPair p = microfacet_pair(wo, wi);
  return microfacet_value(b, wo, wi, p.h, p.cos_h) / wi.z;
}

float microfacet_pdf(BsdfRecord b, vec3 wo, vec3 wi) {
  MicrofacetPair p = microfacet_pair(wo, wi);
  return coated_pdf(p.h, p.o_dot_h, wo, wi.z, microfacets_of(b),
                    microfacet_coat_probability(b, wo));
}

BsdfSample microfacet_sample(BsdfRecord b, vec3 wo, BsdfNumbers n) {
  Microfacets m = microfacets_of(b);
  float p = microfacet_coat_probability(b, wo);
  CoatedDirection d = coated_sample(wo, m, p, n);
  return coated_result(d, wo, m, p, microfacet_value(b, wo, d.wi, d.h, d.cos_h));
}
