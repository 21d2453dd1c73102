// Which pixel and sample a path's slot stands for.
#ifndef FACET_PASS_GLSL
#define FACET_PASS_GLSL
#include "bindings.glsl"
#include "random.glsl"
#include "records.glsl"

/// Pixels are handed out in runs of one workgroup, permuted so that every contiguous part of a
/// dispatch holds work from all over the image: drivers that split a dispatch between threads then
/// give each the same amount.
uint permuted_pixel(uint local) {
  uint runs = pass_constants.pixel_count / WORKGROUP_SIZE;
  uint run = local / WORKGROUP_SIZE;
  // 64-bit products are not everywhere, so the permutation steps in 32 bits: runs * stride < 2^32
  // is the host's care.
  uint moved = run < runs ? (run * pass_constants.stride) % max(runs, 1u) : run;
  return pass_constants.first_pixel + moved * WORKGROUP_SIZE + local % WORKGROUP_SIZE;
}

/// Pixel within the crop, row by row.
uint slot_crop_pixel(uint slot) {
  uint pixel = permuted_pixel(slot % pass_constants.pixel_count);
  return PIXEL_LIST ? fetch_listed_pixel(pixel) : pixel;
}

/// Pixel of the whole image.
uvec2 crop_to_image(uint crop_pixel) {
  return uvec2(frame.crop_x + crop_pixel % frame.crop_width,
               frame.crop_y + crop_pixel / frame.crop_width);
}

/// What a slot's random numbers depend on.
SampleId slot_sample(uint slot) {
  SampleId id;
  id.position = crop_to_image(slot_crop_pixel(slot));
  id.pixel = id.position.y * frame.width + id.position.x;
  id.index = pass_constants.first_sample + slot / pass_constants.pixel_count;
  id.seed = pass_constants.seed;
  id.order_bits = pass_constants.order_bits;
  return id;
}

#endif
