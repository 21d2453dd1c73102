#version 450
// Finds what given rays hit: what benchmarks and tests ask.
#extension GL_GOOGLE_include_directive : require
#include "../lib/records.glsl"
#include "../lib/traversal.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= pass_constants.pixel_count) return;
  bool complete;
  hits[i] = trace_closest(fetch_ray(i), complete);
  if (!complete) atomicAdd(counters[COUNTER_BOUND_HITS], 1u);
}
