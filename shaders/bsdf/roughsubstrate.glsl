/* roughsubstrate: a diffuse base under a rough dielectric coat (glossy paint, plastic).

   | parameter | default  | meaning                                  |
   |-----------|----------|------------------------------------------|
   | kd        | 0.5      | albedo of the base                       |
   | alpha     | 0.1      | roughness of the coat, 1e-4 to 1         |
   | intIOR    | 1.5046   | index of refraction below the surface    |
   | extIOR    | 1.000277 | index above                              |

   f = 28 kd/(23 pi) (1 - F0) (1 - (1 - cos_i/2)^5) (1 - (1 - cos_o/2)^5) + D F G/(4 cos_i cos_o): the diffuse term of
   Ashikhmin and Shirley 2000, whose albedo is kd (1 - F0) (1 - (1 - cos_o/2)^5), and a Beckmann lobe with the exact
   dielectric Fresnel term. The lobe to sample is chosen by those albedos; the pdf is that of both together.
   Record: a.rgb = kd, a.w = alpha, b.x = extIOR, b.y = intIOR, b.z = F0, b.w = mean of kd's channels. */
#include "../lib/bsdf_sample.glsl"
#include "../lib/fresnel.glsl"
#include "../lib/microfacet_lobe.glsl"
#include "../lib/warp.glsl"

/// 1 - (1 - c/2)^5, without cancellation for small c: x (5 - 10 x + 10 x^2 - 5 x^3 + x^4), x = c/2.
float substrate_falloff(float c) {
  float x = 0.5 * c;
  return x * (5.0 + x * (-10.0 + x * (10.0 + x * (-5.0 + x))));
}

vec3 substrate_diffuse(BsdfRecord b, vec3 wo, vec3 wi) {
  // 28/(23 pi)
  return b.a.rgb * (0.387507688 * (1.0 - b.b.z) * substrate_falloff(wi.z) * substrate_falloff(wo.z));
}

/// Probability of choosing the coat.
float substrate_coat_probability(BsdfRecord b, vec3 wo) {
  float coat = fresnel_dielectric(wo.z, b.b.x, b.b.y);
  float base = b.b.w * (1.0 - b.b.z) * substrate_falloff(wo.z);
  // u_lobe counts in steps of 2^-24: neither lobe that has a value is out of its reach.
  float p = min(max(coat / (coat + base), 5.96046448e-8), base > 0.0 ? 0.99999994 : 1.0);
  return coat > 0.0 ? p : 0.0;
}

vec3 roughsubstrate_eval(BsdfRecord b, vec3 wo, vec3 wi) {
  MicrofacetPair p = microfacet_pair(wo, wi);
  float f = fresnel_dielectric(p.cos_h, b.b.x, b.b.y);
  return substrate_diffuse(b, wo, wi) + vec3(f * microfacet_eval(p, wo, wi, b.a.w));
}

float roughsubstrate_pdf(BsdfRecord b, vec3 wo, vec3 wi) {
  float p = substrate_coat_probability(b, wo);
  MicrofacetPair pair = microfacet_pair(wo, wi);
  return p * microfacet_pdf(pair.h, pair.o_dot_h, wo, b.a.w) + (1.0 - p) * wi.z * INV_PI;
}

BsdfSample roughsubstrate_sample(BsdfRecord b, vec3 wo, float lobe, vec2 u) {
  float p = substrate_coat_probability(b, wo);
  bool coat = lobe < p;
  vec3 wh = microfacet_sample_half_vector(wo, b.a.w, u);
  BsdfSample s;
  float o_dot_wh = dot3(wo, wh);
  s.wi = coat ? 2.0 * o_dot_wh * wh - wo : square_to_cosine_hemisphere(u);
  // The coat's own half vector is more exact than the one found again from the two directions.
  MicrofacetPair pair = microfacet_pair(wo, s.wi);
  vec3 h = coat ? wh : pair.h;
  float o_dot_h = coat ? o_dot_wh : pair.o_dot_h;
  float c = coat ? o_dot_wh : pair.cos_h;
  float wi_z = max(s.wi.z, 1.0e-30);
  float g = beckmann_g(vec3(s.wi.xy, wi_z), wo, c, c, b.a.w);
  float coat_value = beckmann_d(h, b.a.w) * 0.25 * fresnel_dielectric(c, b.b.x, b.b.y) * g / wo.z;
  s.pdf = p * microfacet_pdf(h, o_dot_h, wo, b.a.w) + (1.0 - p) * wi_z * INV_PI;
  s.weight = (substrate_diffuse(b, wo, s.wi) * wi_z + vec3(coat_value)) / s.pdf;
  bool valid = s.wi.z > 0.0 && s.pdf > 0.0 && c > 0.0;
  s.weight = valid ? s.weight : vec3(0.0);
  return s;
}
