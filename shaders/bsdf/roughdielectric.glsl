/* roughdielectric: a rough interface between two transparent media, such as ground glass.

   B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, eq. 20
   and 21, with radiance scaled by refraction. Where both indices are equal, light passes straight
   through, dimmed by masking. */
#include "../lib/bsdf_sample.glsl"
#include "../lib/fresnel.glsl"
#include "../lib/microfacet.glsl"

/// The interface seen from above, wherever the viewer is.
struct RoughInterface {
  Microfacets m;
  vec3 wo;
  float eta_o;  // on the viewer's side
  float eta_i;  // beyond
  float side;   // -1 where z is exchanged
};

RoughInterface roughdielectric_interface(BsdfRecord b, vec3 wo) {
  bool below = wo.z < 0.0;
  RoughInterface r;
  r.m = microfacets_of(b);
  r.side = below ? -1.0 : 1.0;
  r.wo = vec3(wo.xy, abs(wo.z));
  r.eta_o = below ? roughdielectric_int_ior(b) : roughdielectric_ext_ior(b);
  r.eta_i = below ? roughdielectric_ext_ior(b) : roughdielectric_int_ior(b);
  return r;
}

/// Probability of reflection at a microfacet of reflectance f, in whole words, within reach.
float roughdielectric_reflection_probability(float f) {
  float p = min(max(f, 5.96046448e-8), 0.99999994);
  return f > 0.0 && f < 1.0 ? whole_words(p) : f;
}

/// Half vector of a refracted pair: not normalised; valid where it is a microfacet that both see
/// from their sides.
struct RefractionPair {
  vec3 h;
  float h2;
  float o_dot_h;  // with the unit half vector
  float i_dot_h;  // negative
  bool valid;
};

RefractionPair roughdielectric_refraction(RoughInterface r, vec3 wi) {
  // eta_o wo + eta_i wi, in the order that keeps its digits where the indices are nearly equal: the
  // two terms almost cancel.
  vec3 sum = r.eta_o * (r.wo + wi) + (r.eta_i - r.eta_o) * wi;
  RefractionPair p;
  p.h = r.eta_o > r.eta_i ? sum : -sum;
  p.h2 = dot3(p.h, p.h);
  float inverse = 1.0 / sqrt(max(p.h2, 1.0e-30));
  p.o_dot_h = dot3(r.wo, p.h) * inverse;
  p.i_dot_h = dot3(wi, p.h) * inverse;
  p.valid = wi.z < 0.0 && p.h.z > 0.0 && p.o_dot_h > 0.0 && p.i_dot_h < 0.0;
  return p;
}

vec3 roughdielectric_eval(BsdfRecord b, vec3 wo, vec3 wi) {
  RoughInterface r = roughdielectric_interface(b, wo);
  vec3 wi_up = vec3(wi.xy, wi.z * r.side);
  float g = microfacet_g(vec3(wi.xy, abs(wi.z)), r.wo, r.m);
  MicrofacetPair up = microfacet_pair(r.wo, wi_up);
  float reflected = fresnel_dielectric(up.cos_h, r.eta_o, r.eta_i) * microfacet_d(up.h, r.m) * 0.25;
  RefractionPair down = roughdielectric_refraction(r, wi_up);
  float t = 1.0 - fresnel_dielectric(down.o_dot_h, r.eta_o, r.eta_i);
  float refracted = abs(down.i_dot_h) * down.o_dot_h * (r.eta_o * r.eta_o) * t *
                    microfacet_d(down.h, r.m) / down.h2;
  float value = wi_up.z > 0.0 ? reflected : (down.valid ? refracted : 0.0);
  return roughdielectric_ka(b) * (value * (g / abs(wi.z)) / r.wo.z);
}

float roughdielectric_pdf(BsdfRecord b, vec3 wo, vec3 wi) {
  RoughInterface r = roughdielectric_interface(b, wo);
  vec3 wi_up = vec3(wi.xy, wi.z * r.side);
  MicrofacetPair up = microfacet_pair(r.wo, wi_up);
  float p_up =
      roughdielectric_reflection_probability(fresnel_dielectric(up.cos_h, r.eta_o, r.eta_i));
  float reflected = p_up * microfacet_pdf(up.h, up.o_dot_h, r.wo, r.m);
  RefractionPair down = roughdielectric_refraction(r, wi_up);
  float p_down =
      roughdielectric_reflection_probability(fresnel_dielectric(down.o_dot_h, r.eta_o, r.eta_i));
  // microfacet_pdf is over 4 wo.h, here of an h that is not normalised.
  float length = sqrt(down.h2);
  float half_vector = microfacet_pdf(down.h, down.o_dot_h * length, r.wo, r.m) * 4.0 * down.o_dot_h;
  float refracted =
      (1.0 - p_down) * half_vector * (r.eta_i * r.eta_i) * abs(down.i_dot_h) / down.h2;
  return wi_up.z > 0.0 ? reflected : (down.valid ? refracted : 0.0);
}

BsdfSample roughdielectric_sample(BsdfRecord b, vec3 wo, BsdfNumbers n) {
  RoughInterface r = roughdielectric_interface(b, wo);
  BsdfSample s = bsdf_sample_none();
  if (HAS_FLAG(b.flags, BSDF_DELTA) && r.eta_o == r.eta_i) {
    float g = microfacet_g1(r.wo, r.m);
    return BsdfSample(-wo, DELTA_PDF,
                      roughdielectric_ka(b) * (g * (g / microfacet_normalisation(r.wo, r.m))), 1.0);
  }
  vec3 wh = microfacet_sample_half_vector(r.wo, r.m, square_of(n));
  float c = dot3(r.wo, wh);
  float f = fresnel_dielectric(c, r.eta_o, r.eta_i);
  float p = roughdielectric_reflection_probability(f);
  bool reflects = is_first(n.lobe, p);
  float e = r.eta_o / r.eta_i;
  float cos_t = sqrt(max(1.0 - e * e * max((1.0 - c) * (1.0 + c), 0.0), 0.0));
  // e c - cos_t, which would cancel for nearly equal indices; eta_i times it is eta_i wi.wh + eta_o
  // wo.wh.
  float bend = (r.eta_o - r.eta_i) * (r.eta_o + r.eta_i) / (r.eta_i * r.eta_i) / (e * c + cos_t);
  vec3 wi = reflects ? 2.0 * c * wh - r.wo : bend * wh - e * r.wo;
  float jacobian = 4.0 * c * cos_t / max(bend * bend, 1.0e-30);
  float pdf_h = microfacet_pdf(wh, c, r.wo, r.m);
  s.pdf = pdf_h * (reflects ? p : (1.0 - p) * jacobian);
  float share = reflects ? f / p : (1.0 - f) / (1.0 - p) * (e * e);
  bool valid = c > 0.0 && (reflects ? wi.z > 0.0 : wi.z < 0.0);
  float lobe_weight = share * microfacet_weight(wh, c, r.wo, vec3(wi.xy, abs(wi.z)), r.m);
  s.weight = valid ? roughdielectric_ka(b) * lobe_weight : vec3(0.0);
  s.eta2 = reflects ? 1.0 : 1.0 / (e * e);
  s.wi = vec3(wi.xy, wi.z * r.side);
  return s;
}
