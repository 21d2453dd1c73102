/* ao: the share of the hemisphere, weighted by the cosine to the shading normal, from which nothing
   blocks the sky. Unbounded; 0 where nothing is hit. One direction a sample. */
#include "path_step.glsl"
#include "../lib/random.glsl"
#include "../lib/surface.glsl"
#include "../lib/warp.glsl"

PathStep shade_ambient_occlusion(PathRecord path, RayRecord ray, HitRecord hit, SampleId id) {
  PathStep step = unchanged_path(path, ray);
  step.has_shadow = hit.triangle != NONE;
  uint triangle = step.has_shadow ? hit.triangle : 0u;
  Surface s = surface_at(triangle, hit.b1, hit.b2);
  vec3 ns = dot3(s.ns, ray.direction.xyz) < 0.0 ? s.ns : -s.ns;
  uvec4 bits = random_block(id, bounce_block(1u) + BOUNCE_BSDF);
  vec3 local =
      square_to_cosine_hemisphere(vec2(unit_float(bits[BSDF_U]), unit_float(bits[BSDF_V])));
  vec3 d = to_world(frame_from_normal(ns), local);
  vec3 from = offset_ray_origin(s.position, s.magnitude, s.ng, d);
  step.shadow = RayRecord(vec4(from, 0.0), vec4(d, LARGEST));
  step.contribution = vec3(1.0);
  return step;
}
