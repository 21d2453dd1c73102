#version 450
// Shades what the queued rays have hit: adds emission, queues a shadow ray and the path's next ray.
#extension GL_GOOGLE_include_directive : require
#include "../integrator/ambient_occlusion.glsl"
#include "../integrator/depth.glsl"
#include "../integrator/normals.glsl"
#include "../integrator/path.glsl"
#include "../integrator/simple.glsl"
#include "../lib/pass.glsl"
#include "../lib/queue.glsl"
#include "../lib/records.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

PathStep shade(uint slot) {
  if (INTEGRATOR == INTEGRATOR_path) {
    return shade_path(fetch_path(slot), fetch_ray(slot), fetch_hit(slot), slot_sample(slot), pass_constants.bounce);
  }
  if (INTEGRATOR == INTEGRATOR_ambient_occlusion) {
    return shade_ambient_occlusion(fetch_path(slot), fetch_ray(slot), fetch_hit(slot), slot_sample(slot));
  }
  if (INTEGRATOR == INTEGRATOR_simple) return shade_simple(fetch_path(slot), fetch_ray(slot), fetch_hit(slot));
  PathStep step;
  step.path = fetch_path(slot);
  step.path.radiance.rgb = INTEGRATOR == INTEGRATOR_normals ? shade_normals(fetch_hit(slot)) : shade_depth(fetch_hit(slot));
  step.alive = false;
  step.has_shadow = false;
  return step;
}

void main() {
  uint slot = queued_slot();
  if (slot == NONE) return;
  PathStep step = shade(slot);
  // Where every emitter is sampled, one at a time, the path moves on with the last.
  bool last = !EVERY_EMITTER || pass_constants.emitter + 1u >= frame.emitter_count;
  if (last) paths[slot] = step.path;
  if (last && step.alive) {
    rays[slot] = step.next;
    push_path(slot);
  }
  if (step.has_shadow) push_shadow_ray(step.shadow, slot);
}
