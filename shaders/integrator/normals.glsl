/* normals: the shading normal of what the camera sees, absolute value of each component; 0 where
   nothing is hit. */
#include "../lib/surface.glsl"

vec3 shade_normals(HitRecord hit) {
  if (hit.triangle == NONE) return vec3(0.0);
  return abs(surface_at(hit.triangle, hit.b1, hit.b2).ns);
}
