/* depth: distance along the ray from the camera to what it sees, in units of the scene; 0 where
   nothing is hit. */
#include "../lib/bindings.glsl"

vec3 shade_depth(HitRecord hit) { return vec3(hit.triangle == NONE ? 0.0 : hit.t); }
