/* microfacet: Nori's rough plastic: a Lambertian base and a rough dielectric coat that share the light by the base's albedo.

   | parameter | default  | meaning                                    |
   |-----------|----------|--------------------------------------------|
   | alpha     | 0.1      | roughness of the coat, 1e-4 to 1           |
   | intIOR    | 1.5046   | index of refraction below the surface      |
   | extIOR    | 1.000277 | index above                                |
   | kd        | 0.5      | albedo of the base; the coat has 1 - max(kd) |
   | distribution, masking | | of the coat's microfacets: see roughconductor |

   f = kd/pi + ks D F G/(4 cos_i cos_o), ks = 1 - max(kd), F dielectric.
   Record: a.rgb = kd, a.w = alpha, b.x = extIOR, b.y = intIOR. */
#include "../lib/coated.glsl"
#include "../lib/fresnel.glsl"

/// Probability of choosing the coat.
float microfacet_coat_probability(BsdfRecord b, vec3 wo) {
  float ks = 1.0 - max(b.a.r, max(b.a.g, b.a.b));
  return coated_probability(ks * fresnel_dielectric(wo.z, b.b.x, b.b.y), mean3(b.a.rgb));
}

/// Value of both lobes times cos_i, for the half vector h of any length; c: cosine between either direction and h.
vec3 microfacet_value(BsdfRecord b, vec3 wo, vec3 wi, vec3 h, float c) {
  Microfacets m = microfacets_of(b);
  vec3 base = b.a.rgb * (INV_PI * wi.z);
  float ks = 1.0 - max(b.a.r, max(b.a.g, b.a.b));
  float coat = microfacet_d(h, m) * 0.25 * fresnel_dielectric(c, b.b.x, b.b.y) * microfacet_g(wi, wo, m) / wo.z;
  return base + vec3(ks * coat);
}

vec3 microfacet_eval(BsdfRecord b, vec3 wo, vec3 wi) {
  MicrofacetPair p = microfacet_pair(wo, wi);
  return microfacet_value(b, wo, wi, p.h, p.cos_h) / wi.z;
}

float microfacet_pdf(BsdfRecord b, vec3 wo, vec3 wi) {
  MicrofacetPair p = microfacet_pair(wo, wi);
  return coated_pdf(p.h, p.o_dot_h, wo, wi.z, microfacets_of(b), microfacet_coat_probability(b, wo));
}

BsdfSample microfacet_sample(BsdfRecord b, vec3 wo, float lobe, vec2 u) {
  Microfacets m = microfacets_of(b);
  float p = microfacet_coat_probability(b, wo);
  CoatedDirection d = coated_sample(wo, m, p, lobe, u);
  return coated_result(d, wo, m, p, microfacet_value(b, wo, d.wi, d.h, d.cos_h));
}
