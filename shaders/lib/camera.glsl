// Rays from the camera, through a point of the pixel's reconstruction filter.
#ifndef FACET_CAMERA_GLSL
#define FACET_CAMERA_GLSL
#include "frame.glsl"
#include "pass.glsl"
#include "records.glsl"

/// Offset from the pixel's centre along one axis, distributed as |filter|: within one of the
/// table's intervals of equal mass the density runs linearly (docs/reference/sampling.md,
/// "Filter").
float sample_filter(float u) {
  float scaled = u * float(frame.filter_intervals);
  uint i = min(uint(scaled), frame.filter_intervals - 1u);
  // Offset and |filter| at either end.
  vec4 ends = fetch_filter_interval(i);
  vec2 a = ends.xy;
  vec2 b = ends.zw;
  float f = scaled - float(i);
  // Share of the interval at which the linear density's cumulative distribution is f.
  float root = sqrt(max(a.y * a.y + f * (b.y * b.y - a.y * a.y), 0.0));
  float share = a.y + b.y > 0.0 ? f * (a.y + b.y) / max(a.y + root, 1.0e-30) : f;
  return a.x + (b.x - a.x) * min(share, 1.0);
}

/// Sign and scale of the filter at an offset: a sample's weight along one axis.
float filter_weight(float offset) {
  return abs(offset) > frame.filter_crossing ? -frame.filter_scale : frame.filter_scale;
}

/// Offsets of a sample from its pixel's centre.
vec2 filter_offset(SampleId id) {
  uvec4 bits = random_block(id, BLOCK_CAMERA);
  return vec2(sample_filter(unit_float(bits[CAMERA_FILTER_X])),
              sample_filter(unit_float(bits[CAMERA_FILTER_Y])));
}

/// Weight of a slot's sample: that of its offset, which is the same everywhere unless the filter is
/// negative in parts.
float sample_weight(uint slot) {
  if (!NEGATIVE_FILTER) return frame.filter_scale * frame.filter_scale;
  vec2 offset = filter_offset(slot_sample(slot));
  return filter_weight(offset.x) * filter_weight(offset.y);
}

RayRecord camera_ray(uvec2 pixel, vec2 offset) {
  vec2 at = vec2(pixel) + vec2(0.5) + offset;
  vec3 d = frame.camera_corner.xyz + at.x * frame.camera_dx.xyz + at.y * frame.camera_dy.xyz;
  vec3 unit = normalize_safe(d);
  // d has length 1 along the camera's z axis, in units of that axis: the clip planes lie at these
  // distances along the ray.
  float scale = dot3(d, unit);
  return RayRecord(vec4(frame.camera_origin.xyz, frame.camera_origin.w * scale),
                   vec4(unit, frame.camera_corner.w * scale));
}

#endif
