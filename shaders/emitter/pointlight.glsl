/* pointlight: light from a point, equal in all directions.

   No ray finds it: estimators that sample BSDFs alone do not see it. */
#include "parameters.glsl"
#include "../lib/bindings.glsl"
#include "../lib/emitter_sample.glsl"
#include "../lib/surface.glsl"

EmitterSample pointlight_sample(EmitterRecord e, Surface from) {
  vec3 to = pointlight_position(e) - from.position;
  EmitterSample r;
  r.d = normalize_safe(to);
  float distance = dot3(to, r.d);
  bool apart = distance > 0.0;
  r.radiance = apart ? pointlight_radiance(e) / distance / distance : vec3(0.0);
  r.pdf = apart ? 1.0 : 0.0;
  r.point = pointlight_position(e);
  r.at_infinity = false;
  r.delta = true;
  return r;
}
