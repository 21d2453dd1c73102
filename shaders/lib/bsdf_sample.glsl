// What sampling a BSDF gives.
#ifndef FACET_BSDF_SAMPLE_GLSL
#define FACET_BSDF_SAMPLE_GLSL
#include "../shared/records.h"
#include "choice.glsl"
#include "random.glsl"

/// Words of a sample (docs/reference/sampling.md, "BSDF sample").
struct BsdfNumbers {
  uint lobe;
  uint u;
  uint v;
};

BsdfNumbers bsdf_numbers(uvec4 block) {
  return BsdfNumbers(block[BSDF_LOBE], block[BSDF_U], block[BSDF_V]);
}

/// A point of the unit square.
vec2 square_of(BsdfNumbers n) { return vec2(unit_float(n.u), unit_float(n.v)); }

/// Whether the first of two lobes is chosen, of probability p in whole words; u keeps the
/// remainder.
bool choose_first_lobe(inout BsdfNumbers n, float p) { return choose_first(n.u, p, n.lobe); }

struct BsdfSample {
  vec3 wi;      // shading frame, unit
  float pdf;    // sr^-1; DELTA_PDF: wi is the one direction of a delta lobe
  vec3 weight;  // f |cos(theta_i)| / pdf; 0 where the sample is rejected
  float
      eta2;  // (eta_i/eta_o)^2 of a refraction, which has changed the weight by its inverse; else 1
};

BsdfSample bsdf_sample_none() { return BsdfSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 1.0); }

#endif
