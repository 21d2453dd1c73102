/* diffuse: Lambertian reflection.

   f = albedo / pi. Sampled by the cosine-weighted hemisphere, so that f cos / pdf = albedo. */
#include "../lib/bsdf_sample.glsl"
#include "../lib/warp.glsl"
#include "parameters.glsl"

vec3 diffuse_eval(BsdfRecord b, vec3 wo, vec3 wi) { return diffuse_albedo(b) * INV_PI; }

float diffuse_pdf(BsdfRecord b, vec3 wo, vec3 wi) { return wi.z * INV_PI; }

BsdfSample diffuse_sample(BsdfRecord b, vec3 wo, BsdfNumbers n) {
  BsdfSample s = bsdf_sample_none();
  s.wi = square_to_cosine_hemisphere(square_of(n));
  s.pdf = s.wi.z * INV_PI;
  s.weight = diffuse_albedo(b);
  return s;
}
