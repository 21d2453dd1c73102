#version 450
// One bounce of every path in the queue: finds what its ray hits, shades that, and adds what
// arrives where the shadow ray meets nothing. All of it in one kernel, so that rays and hits stay
// in registers. Paths that go on are queued for the next bounce.
#extension GL_GOOGLE_include_directive : require
#include "../integrator/ambient_occlusion.glsl"
#include "../integrator/depth.glsl"
#include "../integrator/normals.glsl"
#include "../integrator/path.glsl"
#include "../integrator/simple.glsl"
#include "../lib/camera.glsl"
#include "../lib/queue.glsl"
#include "../lib/records.glsl"
#include "../lib/traversal.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

/// Slot that this invocation works on, NONE beyond the last.
uint slot_of_invocation() {
  uint i = gl_GlobalInvocationID.x;
  if (CAMERA_BOUNCE) return i < pass_constants.pixel_count * pass_constants.sample_count ? i : NONE;
  return queued_slot(i);
}

/// Where every emitter is sampled, a bounce is a round for each of them; the first finds the hit,
/// the last moves the path on.
bool is_first_round() { return !EVERY_EMITTER || pass_constants.emitter == 0u; }
bool is_last_round() {
  return !EVERY_EMITTER || pass_constants.emitter + 1u >= frame.emitter_count;
}

PathRecord path_of(uint slot) {
  if (!CAMERA_BOUNCE) return fetch_path(slot);
  PathRecord path = PathRecord(vec4(1.0, 1.0, 1.0, 0.0), vec4(0.0, 0.0, 0.0, 1.0));
  if (EVERY_EMITTER && !is_first_round()) path.radiance.rgb = fetch_path(slot).radiance.rgb;
  return path;
}

RayRecord ray_of(uint slot, SampleId id) {
  if (CAMERA_BOUNCE) return camera_ray(crop_to_image(slot_crop_pixel(slot)), filter_offset(id));
  return fetch_ray(slot);
}

HitRecord hit_of(uint slot, RayRecord ray, inout bool complete) {
  if (!EVERY_EMITTER) return trace_closest(ray, complete);
  HitRecord hit;
  if (is_first_round()) {
    hit = trace_closest(ray, complete);
    hits[slot] = hit;
  } else {
    hit = fetch_hit(slot);
  }
  return hit;
}

PathStep shade(PathRecord path, RayRecord ray, HitRecord hit, SampleId id) {
  if (INTEGRATOR == INTEGRATOR_path) return shade_path(path, ray, hit, id, pass_constants.bounce);
  if (INTEGRATOR == INTEGRATOR_ambient_occlusion)
    return shade_ambient_occlusion(path, ray, hit, id);
  if (INTEGRATOR == INTEGRATOR_simple) return shade_simple(path, ray, hit);
  PathStep step = unchanged_path(path, ray);
  step.path.radiance.rgb = INTEGRATOR == INTEGRATOR_normals ? shade_normals(hit) : shade_depth(hit);
  return step;
}

void main() {
  uint slot = slot_of_invocation();
  if (slot == NONE) return;
  SampleId id = slot_sample(slot);
  PathRecord path = path_of(slot);
  RayRecord queued = ray_of(slot, id);
  RayRecord ray = LIGHT_TREE && !CAMERA_BOUNCE ? without_normal(queued) : queued;
  bool complete = true;
  HitRecord hit = hit_of(slot, ray, complete);
  PathStep step = shade(path, queued, hit, id);
  if (!is_last_round()) step.path = path;
  if (step.has_shadow) {
    bool shadow_complete;
    bool occluded = trace_any(step.shadow, shadow_complete);
    step.path.radiance.rgb =
        occluded ? step.path.radiance.rgb : step.path.radiance.rgb + step.contribution;
    complete = complete && shadow_complete;
    atomicAdd(counters[COUNTER_ANY_RAYS], 1u);
  }
  if (ONLY_BOUNCE) {
    paths[slot].radiance = step.path.radiance;
  } else {
    paths[slot] = step.path;
  }
  if (is_last_round() && step.alive) {
    rays[slot] = step.next;
    push_path(slot);
  }
  if (!complete) atomicAdd(counters[COUNTER_BOUND_HITS], 1u);
}
