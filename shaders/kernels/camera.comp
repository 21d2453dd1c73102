#version 450
// The camera's rays alone: what benchmarks and tests ask.
#extension GL_GOOGLE_include_directive : require
#include "../lib/camera.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
  uint slot = gl_GlobalInvocationID.x;
  if (slot >= pass_constants.pixel_count * pass_constants.sample_count) return;
  rays[slot] = camera_ray(crop_to_image(slot_crop_pixel(slot)), filter_offset(slot_sample(slot)));
}
