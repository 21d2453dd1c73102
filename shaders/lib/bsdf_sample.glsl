// What sampling a BSDF gives.
#ifndef FACET_BSDF_SAMPLE_GLSL
#define FACET_BSDF_SAMPLE_GLSL
#include "../shared/records.h"

struct BsdfSample {
  vec3 wi;      // shading frame, unit
  float pdf;    // sr^-1; DELTA_PDF: wi is the one direction of a delta lobe
  vec3 weight;  // f |cos(theta_i)| / pdf; 0 where the sample is rejected
  float
      eta2;  // (eta_i/eta_o)^2 of a refraction, which has changed the weight by its inverse; else 1
};

BsdfSample bsdf_sample_none() { return BsdfSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 1.0); }

#endif
