/* roughconductor: rough metal with Beckmann microfacets and Schlick's Fresnel term.

   | parameter | default | meaning                             |
   |-----------|---------|-------------------------------------|
   | alpha     | 0.1     | roughness, 1e-4 to 1                |
   | R0        | 0.5     | reflectance at normal incidence     |

   f = D(wh) F(wh.wi) G(wi, wo) / (4 cos_i cos_o), separable Smith G in Walter's rational form.
   Sampling: `ndf` (wh ~ D cos_h) or `visible` (Heitz and d'Eon 2014), docs/sampling.md.
   Record: a.rgb = R0, a.w = alpha. */
#include "../lib/bsdf_sample.glsl"
#include "../lib/fresnel.glsl"
#include "../lib/microfacet_lobe.glsl"

vec3 roughconductor_eval(BsdfRecord b, vec3 wo, vec3 wi) {
  MicrofacetPair p = microfacet_pair(wo, wi);
  return fresnel_schlick(b.a.rgb, p.cos_h) * microfacet_eval(p, wo, wi, b.a.w);
}

float roughconductor_pdf(BsdfRecord b, vec3 wo, vec3 wi) {
  MicrofacetPair p = microfacet_pair(wo, wi);
  return microfacet_pdf(p.h, p.o_dot_h, wo, b.a.w);
}

BsdfSample roughconductor_sample(BsdfRecord b, vec3 wo, float lobe, vec2 u) {
  vec3 wh = microfacet_sample_half_vector(wo, b.a.w, u);
  float c = dot3(wo, wh);
  BsdfSample s;
  s.wi = 2.0 * c * wh - wo;
  s.pdf = microfacet_pdf(wh, c, wo, b.a.w);
  s.weight = fresnel_schlick(b.a.rgb, c) * microfacet_weight(wh, wo, s.wi, b.a.w);
  return s;
}
