/* mirror: reflects everything into the mirrored direction; no parameters. */
#include "../lib/bsdf_sample.glsl"

vec3 mirror_eval(BsdfRecord b, vec3 wo, vec3 wi) { return vec3(0.0); }

float mirror_pdf(BsdfRecord b, vec3 wo, vec3 wi) { return 0.0; }

BsdfSample mirror_sample(BsdfRecord b, vec3 wo, BsdfNumbers n) {
  return BsdfSample(vec3(-wo.x, -wo.y, wo.z), DELTA_PDF, vec3(1.0), 1.0);
}
