/* simple: light from a point of given energy on what the camera sees, whatever its material: Nori's
   first shading exercise.

   energy/(4 pi^2) max(0, cos) / d^2 where the light is visible, cos being that to the shading
   normal. */
#include "path_step.glsl"
#include "../lib/surface.glsl"

PathStep shade_simple(PathRecord path, RayRecord ray, HitRecord hit) {
  PathStep step = unchanged_path(path, ray);
  bool found = hit.triangle != NONE;
  Surface s = surface_at(found ? hit.triangle : 0u, hit.b1, hit.b2);
  vec3 to = frame.simple_position.xyz - s.position;
  vec3 d = normalize_safe(to);
  float distance = dot3(to, d);
  float cosine = dot3(s.ns, d);
  vec3 light = frame.simple_energy.rgb * (cosine / distance / distance);
  vec3 from = offset_ray_origin(s.position, s.magnitude, s.ng, d);
  step.has_shadow = found && cosine > 0.0 && distance > 0.0;
  step.shadow = RayRecord(vec4(from, 0.0), vec4(frame.simple_position.xyz - from, 1.0));
  step.contribution = light;
  return step;
}
