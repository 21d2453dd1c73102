/* dielectric: a smooth interface between two transparent media, such as glass or water.

   Reflects with probability F, the exact Fresnel term, else refracts by Snell's law; refracted
   radiance is scaled by (eta_o/eta_i)^2, eta_o being the index on the viewer's side. */
#include "../lib/bsdf_sample.glsl"
#include "../lib/fresnel.glsl"
#include "parameters.glsl"

vec3 dielectric_eval(BsdfRecord b, vec3 wo, vec3 wi) { return vec3(0.0); }

float dielectric_pdf(BsdfRecord b, vec3 wo, vec3 wi) { return 0.0; }

BsdfSample dielectric_sample(BsdfRecord b, vec3 wo, BsdfNumbers n) {
  bool below = wo.z < 0.0;
  float eta_o = below ? dielectric_int_ior(b) : dielectric_ext_ior(b);
  float eta_i = below ? dielectric_ext_ior(b) : dielectric_int_ior(b);
  bool reflects =
      choose_first_lobe(n, fresnel_dielectric(wo.z, dielectric_ext_ior(b), dielectric_int_ior(b)));
  float e = eta_o / eta_i;
  float cos_t = sqrt(max(1.0 - e * e * (wo.x * wo.x + wo.y * wo.y), 0.0));
  BsdfSample s = bsdf_sample_none();
  s.wi = reflects ? vec3(-wo.x, -wo.y, wo.z) : vec3(-e * wo.x, -e * wo.y, below ? cos_t : -cos_t);
  s.pdf = DELTA_PDF;
  s.weight = vec3(reflects ? 1.0 : e * e);
  s.eta2 = reflects ? 1.0 : 1.0 / (e * e);
  return s;
}
