#version 450
// Samples of one BSDF: what tests ask.
#extension GL_GOOGLE_include_directive : require
#include "../lib/bsdf.glsl"
#include "../lib/bindings.glsl"
#include "../lib/random.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

/// Of a path's first interaction.
BsdfNumbers path_numbers(uint index) {
  SampleId id = SampleId(0u, evaluation.first_sample + index, evaluation.seed, uvec2(0u), 0u);
  return bsdf_numbers(random_block(id, bounce_block(1u) + BOUNCE_BSDF));
}

/// Those of a query, multiples of 2^-24.
BsdfNumbers given_numbers(uint index) {
  uvec3 words = uvec3(queries[index].first.xyz * 16777216.0) << 8u;
  return BsdfNumbers(words.x, words.y, words.z);
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= evaluation.count) return;
  bool given = evaluation.given == 1u;
  BsdfNumbers numbers = path_numbers(i);
  if (given) numbers = given_numbers(i);
  vec3 wo = given ? queries[i].second.xyz : evaluation.wo.xyz;
  BsdfSample s = bsdf_sample(fetch_bsdf(0u), wo, numbers);
  values[i] = vec4(s.wi, s.pdf);
  weights[i] = vec4(s.weight, 0.0);
}
