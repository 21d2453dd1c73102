#version 450
// Adds the finished samples of a pass to their pixels, in the order of the samples: the sum depends
// neither on queues nor on the size of a pass.
#extension GL_GOOGLE_include_directive : require
#include "../lib/camera.glsl"
#include "../lib/film.glsl"
#include "../lib/records.glsl"
#include "../lib/specialization.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
  uint local = gl_GlobalInvocationID.x;
  if (local >= pass_constants.pixel_count) return;
  uint pixel = slot_crop_pixel(local) - pass_constants.film_first;
  FilmRecord sums = fetch_film(pixel);
  FilmRecord squares = sums;
  if (VARIANCE) squares = fetch_film_squares(pixel);
  uint bad = 0u;
  uint k = pass_constants.film_begin;
  while (k < pass_constants.film_end) {
    uint slot = local + k * pass_constants.pixel_count;
    vec3 radiance = fetch_path(slot).radiance.rgb;
    bool good = is_good_sample(radiance);
    vec3 value = radiance * sample_weight(slot);
    if (good) add_sample(sums, value);
    if (VARIANCE && good) add_square(squares, value * frame.square_scale);
    bad += good ? 0u : 1u;
    ++k;
  }
  film[pixel] = sums;
  if (VARIANCE) film_squares[pixel] = squares;
  if (bad > 0u) atomicAdd(counters[COUNTER_BAD_SAMPLES], bad);
  if (k < pass_constants.film_end) atomicAdd(counters[COUNTER_BOUND_HITS], 1u);
}
