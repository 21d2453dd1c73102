/* environment: light from infinitely far away, constant or from a latitude-longitude image.

   Direction d looks up u = atan2(d.z, d.x)/2pi (+1 if negative), v = acos(d.y)/pi at image
   coordinates ((1-u) W, (1-v) H), bilinear: texel (i, j) has its value at coordinates (i, j), as in
   Nori; u wraps, v clamps. Sampled by the mean of the four texels around each cell [i, i+1) x [j,
   j+1) times the cell's solid angle, uniformly within it (docs/reference/sampling.md). */
#include "../lib/records.glsl"
#include "../lib/elementary.glsl"
#include "../lib/emitter_sample.glsl"
#include "../lib/frame.glsl"
#include "../lib/choice.glsl"
#include "../lib/random.glsl"

/// Image coordinates of a direction: x in [0, W], y in [0, H], in texels.
vec2 environment_coordinates(vec3 d) {
  float phi = atan2_accurate(d.z, d.x) * INV_TWO_PI;
  float u = phi < 0.0 ? phi + 1.0 : phi;
  float v = atan2_accurate(sqrt(d.x * d.x + d.z * d.z), d.y) * INV_PI;
  return vec2((1.0 - u) * float(frame.environment_width),
              (1.0 - v) * float(frame.environment_height));
}

/// A texel: rgb, and the density of its cell in sr^-1.
vec4 environment_at(uint x, uint y) {
  return fetch_environment_texel(y * frame.environment_width + x);
}

/// Radiance arriving from direction d.
vec3 environment_eval(vec3 d) {
  uint w = frame.environment_width;
  uint h = frame.environment_height;
  vec2 at = environment_coordinates(d);
  vec2 base = floor(at);
  vec2 f = at - base;
  uint x0 = uint(base.x) % w;
  uint x1 = (x0 + 1u) % w;
  uint y0 = min(uint(base.y), h - 1u);
  uint y1 = min(y0 + 1u, h - 1u);
  vec3 top = (1.0 - f.x) * environment_at(x0, y0).rgb + f.x * environment_at(x1, y0).rgb;
  vec3 bottom = (1.0 - f.x) * environment_at(x0, y1).rgb + f.x * environment_at(x1, y1).rgb;
  return (1.0 - f.y) * top + f.y * bottom;
}

/// Density, sr^-1, of sampling direction d once the environment is chosen.
float environment_pdf(vec3 d) {
  vec2 at = environment_coordinates(d);
  uint x = min(uint(at.x), frame.environment_width - 1u);
  uint y = min(uint(at.y), frame.environment_height - 1u);
  return environment_at(x, y).w;
}

#define FACET_ROW_COUNT(i) fetch_environment_row(i).cumulative
FACET_DEFINE_CHOICE(choose_environment_row, FACET_ROW_COUNT)
#define FACET_COLUMN_COUNT(i) fetch_environment_column(i)
FACET_DEFINE_CHOICE(choose_environment_cell, FACET_COLUMN_COUNT)

/// u, v: words; each with its fill.
EmitterSample environment_sample(uint u, uint v, uint u_fill, uint v_fill) {
  uint row_word = choice_word(v);
  uint row = choose_environment_row(0u, frame.environment_height - 1u, row_word);
  EnvironmentRow chosen = fetch_environment_row(row);
  uint row_begin = row > 0u ? fetch_environment_row(row - 1u).cumulative : 0u;
  float fy = unit_float(remainder_word(row_word, row_begin, chosen.cumulative, v_fill));
  uint column_word = choice_word(u);
  uint first = row * frame.environment_width;
  uint cell = choose_environment_cell(first, first + frame.environment_width - 1u, column_word);
  uint cell_begin = cell > first ? fetch_environment_column(cell - 1u) : 0u;
  float fx =
      unit_float(remainder_word(column_word, cell_begin, fetch_environment_column(cell), u_fill));
  float y = lerp(chosen.y_begin, chosen.y_end, fy);
  float radius = sqrt(max((1.0 - y) * (1.0 + y), 0.0));
  vec2 sc = sincos_turns(1.0 - (float(cell - first) + fx) / float(frame.environment_width));
  EmitterSample r;
  r.d = vec3(radius * sc.y, y, radius * sc.x);
  r.pdf = fetch_environment_texel(cell).w;
  r.radiance = environment_eval(r.d);
  r.point = r.d;
  r.at_infinity = true;
  r.delta = false;
  return r;
}
