#version 450
// Samples of one BSDF seen from one direction: what tests ask.
#extension GL_GOOGLE_include_directive : require
#include "../lib/bsdf.glsl"
#include "../lib/bindings.glsl"
#include "../lib/random.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

/// Lobe, u and v of a path's first interaction.
vec3 random_numbers(uint index) {
  SampleId id = SampleId(0u, evaluation.first_sample + index, evaluation.seed);
  uvec4 words = random_block(id, bounce_block(1u) + BOUNCE_BSDF);
  return vec3(unit_float(words[BSDF_LOBE]), unit_float(words[BSDF_U]), unit_float(words[BSDF_V]));
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= evaluation.count) return;
  vec3 numbers = random_numbers(i);
  if (evaluation.given == 1u) numbers = queries[i].first.xyz;
  BsdfSample s = bsdf_sample(fetch_bsdf(0u), evaluation.wo.xyz, numbers.x, numbers.yz);
  values[i] = vec4(s.wi, s.pdf);
  weights[i] = vec4(s.weight, 0.0);
}
