#version 450
// Value and density of one BSDF for pairs of directions: what tests ask.
#extension GL_GOOGLE_include_directive : require
#include "../lib/bsdf.glsl"
#include "../lib/bindings.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= evaluation.count) return;
  BsdfRecord b = fetch_bsdf(0u);
  vec3 wo = queries[i].first.xyz;
  vec3 wi = queries[i].second.xyz;
  values[i] = vec4(bsdf_eval(b, wo, wi), bsdf_pdf(b, wo, wi));
}
