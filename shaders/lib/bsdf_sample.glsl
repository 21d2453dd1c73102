// What sampling a BSDF gives.
#ifndef FACET_BSDF_SAMPLE_GLSL
#define FACET_BSDF_SAMPLE_GLSL
#include "../shared/records.h"

struct BsdfSample {
  vec3 wi;      // shading frame, unit; wi.z <= 0: rejected
  float pdf;    // sr^-1
  vec3 weight;  // f cos(theta_i) / pdf
};

#endif
