/* roughconductor: rough metal.

   f = D(wh) F(wh.wi) G(wi, wo) / (4 cos_i cos_o), G separable Smith masking. Sampling: `ndf`
   (wh ~ D cos_h) or `visible` (Heitz and d'Eon 2014; Dupuy and Benyoub 2023), docs/reference/sampling.md. */
#include "../lib/bsdf_sample.glsl"
#include "../lib/fresnel.glsl"
#include "../lib/microfacet.glsl"
#include "../lib/multiscatter.glsl"

vec3 roughconductor_fresnel(BsdfRecord b, float c) {
  if (HAS_FLAG(b.flags, BSDF_CONDUCTOR))
    return fresnel_conductor(roughconductor_eta(b), roughconductor_k(b), c);
  return fresnel_schlick(roughconductor_r0(b), c);
}

/// Energy that multiple scattering gives back.
vec3 roughconductor_gain(BsdfRecord b, vec3 wo) {
  if (HAS_FLAG(b.flags, BSDF_MULTISCATTER)) {
    return multiscatter_factor(roughconductor_fresnel(b, 1.0), wo.z, microfacets_of(b));
  }
  return vec3(1.0);
}

vec3 roughconductor_eval(BsdfRecord b, vec3 wo, vec3 wi) {
  Microfacets m = microfacets_of(b);
  MicrofacetPair p = microfacet_pair(wo, wi);
  float lobe = microfacet_d(p.h, m) * 0.25 * (microfacet_g(wi, wo, m) / wi.z) / wo.z;
  return roughconductor_fresnel(b, p.cos_h) * roughconductor_gain(b, wo) * lobe;
}

float roughconductor_pdf(BsdfRecord b, vec3 wo, vec3 wi) {
  MicrofacetPair p = microfacet_pair(wo, wi);
  return microfacet_pdf(p.h, p.o_dot_h, wo, microfacets_of(b));
}

BsdfSample roughconductor_sample(BsdfRecord b, vec3 wo, BsdfNumbers n) {
  Microfacets m = microfacets_of(b);
  vec3 wh = microfacet_sample_half_vector(wo, m, square_of(n));
  float c = dot3(wo, wh);
  BsdfSample s = bsdf_sample_none();
  s.wi = 2.0 * c * wh - wo;
  s.pdf = microfacet_pdf(wh, c, wo, m);
  bool valid = s.wi.z > 0.0 && c > 0.0;
  vec3 color = roughconductor_fresnel(b, c) * roughconductor_gain(b, wo);
  s.weight = valid ? color * microfacet_weight(wh, c, wo, s.wi, m) : vec3(0.0);
  return s;
}
