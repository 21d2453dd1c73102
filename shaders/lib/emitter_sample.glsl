// What sampling an emitter gives.
#ifndef FACET_EMITTER_SAMPLE_GLSL
#define FACET_EMITTER_SAMPLE_GLSL

struct EmitterSample {
  vec3 d;            // unit direction from the shaded point
  vec3 radiance;     // arriving if nothing is in between, W sr^-1 m^-2
  float pdf;         // sr^-1
  vec3 point;        // end of the shadow ray, world space
  bool at_infinity;  // the shadow ray has no end
  bool delta;        // no ray finds this emitter: its sample has all the weight
};

#endif
