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

/// Probabilities of reflection and of refraction at a microfacet. The rarer one is a number of
/// whole words, and at least 2^-10 unless it is 0: of fewer words, one more or less would show.
struct RoughChoice {
  float reflection;
  float refraction;
  bool reflection_is_rarer;
};

RoughChoice roughdielectric_choice(FresnelShares f) {
  float least = min(f.reflected, f.transmitted);
  float p = least > 0.0 ? whole_words(max(least, 9.765625e-4)) : 0.0;
  return f.reflected <= f.transmitted ? RoughChoice(p, 1.0 - p, true)
                                      : RoughChoice(1.0 - p, p, false);
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
  float t = fresnel_shares(down.o_dot_h, r.eta_o, r.eta_i).transmitted;
  float refracted = abs(down.i_dot_h) * down.o_dot_h * (r.eta_o * r.eta_o) * t *
                    microfacet_d(down.h, r.m) / down.h2;
  float value = wi_up.z > 0.0 ? reflected : (down.valid ? refracted : 0.0);
  return roughdielectric_ka(b) * (value * (g / abs(wi.z)) / r.wo.z);
}

float roughdielectric_pdf(BsdfRecord b, vec3 wo, vec3 wi) {
  RoughInterface r = roughdielectric_interface(b, wo);
  vec3 wi_up = vec3(wi.xy, wi.z * r.side);
  MicrofacetPair up = microfacet_pair(r.wo, wi_up);
  float p_up = roughdielectric_choice(fresnel_shares(up.cos_h, r.eta_o, r.eta_i)).reflection;
  float reflected = p_up * microfacet_pdf(up.h, up.o_dot_h, r.wo, r.m);
  RefractionPair down = roughdielectric_refraction(r, wi_up);
  float p_down = roughdielectric_choice(fresnel_shares(down.o_dot_h, r.eta_o, r.eta_i)).refraction;
  // microfacet_pdf is over 4 wo.h, here of an h that is not normalised.
  float length = sqrt(down.h2);
  float half_vector = microfacet_pdf(down.h, down.o_dot_h * length, r.wo, r.m) * 4.0 * down.o_dot_h;
  float refracted = p_down * half_vector * (r.eta_i * r.eta_i) * abs(down.i_dot_h) / down.h2;
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
  FresnelShares f = fresnel_shares(c, r.eta_o, r.eta_i);
  RoughChoice choice = roughdielectric_choice(f);
  bool is_rarer = is_first(n.lobe, min(choice.reflection, choice.refraction));
  bool reflects = is_rarer == choice.reflection_is_rarer;
  float p = reflects ? choice.reflection : choice.refraction;
  float e = r.eta_o / r.eta_i;
  float cos_t = sqrt(max(1.0 - e * e * max((1.0 - c) * (1.0 + c), 0.0), 0.0));
  // e c - cos_t, which would cancel for nearly equal indices; eta_i times it is eta_i wi.wh + eta_o
  // wo.wh.
  float bend = (r.eta_o - r.eta_i) * (r.eta_o + r.eta_i) / (r.eta_i * r.eta_i) / (e * c + cos_t);
  vec3 wi = reflects ? 2.0 * c * wh - r.wo : bend * wh - e * r.wo;
  float jacobian = 4.0 * c * cos_t / max(bend * bend, 1.0e-30);
  float pdf_h = microfacet_pdf(wh, c, r.wo, r.m);
  s.pdf = pdf_h * (reflects ? p : p * jacobian);
  float share = reflects ? f.reflected / p : f.transmitted / p * (e * e);
  bool valid = c > 0.0 && (reflects ? wi.z > 0.0 : wi.z < 0.0);
  float lobe_weight = share * microfacet_weight(wh, c, r.wo, vec3(wi.xy, abs(wi.z)), r.m);
  s.weight = valid ? roughdielectric_ka(b) * lobe_weight : vec3(0.0);
  s.eta2 = reflects ? 1.0 : 1.0 / (e * e);
  s.wi = vec3(wi.xy, wi.z * r.side);
  return s;
}
