#version 450
// Adds the contribution of every queued shadow ray that meets nothing. A path has at most one of them at a time.
#extension GL_GOOGLE_include_directive : require
#include "../lib/records.glsl"
#include "../lib/traversal.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= counters[COUNTER_SHADOW]) return;
  ShadowRayRecord shadow = fetch_shadow_ray(i);
  RayRecord ray = RayRecord(shadow.origin, shadow.direction);
  bool complete;
  bool occluded = trace_any(ray, complete);
  vec3 contribution = vec3(shadow.contribution_r, shadow.contribution_g, shadow.contribution_b);
  if (!occluded) paths[shadow.slot].radiance.rgb = fetch_path(shadow.slot).radiance.rgb + contribution;
  if (!complete) atomicAdd(counters[COUNTER_BOUND_HITS], 1u);
}
