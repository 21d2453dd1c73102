#version 450
// Starts the paths of a pass: one ray from the camera a slot.
#extension GL_GOOGLE_include_directive : require
#include "../lib/camera.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
  uint slot = gl_GlobalInvocationID.x;
  if (slot >= pass_constants.pixel_count * pass_constants.sample_count) return;
  SampleId id = slot_sample(slot);
  uvec2 pixel = crop_to_image(slot_crop_pixel(slot));
  rays[slot] = camera_ray(pixel, filter_offset(id));
  paths[slot] = PathRecord(vec4(1.0, 1.0, 1.0, 0.0), vec4(0.0, 0.0, 0.0, 1.0));
  queues[slot] = slot;
}
