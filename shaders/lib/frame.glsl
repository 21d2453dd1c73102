// Vectors, shading frames and error-bounded ray origins.
#ifndef FACET_FRAME_GLSL
#define FACET_FRAME_GLSL
#include "constants.glsl"
#include "vector.glsl"

/// Unit vector along v whatever its length (its square may over- or underflow); 0 for the zero
/// vector.
vec3 normalize_safe(vec3 v) {
  float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
  vec3 s = largest > 0.0 ? v / largest : vec3(0.0);
  float l2 = s.x * s.x + s.y * s.y + s.z * s.z;
  return l2 > 0.0 ? s / sqrt(l2) : vec3(0.0);
}

/// Orthonormal frame; n is its z axis.
struct Frame {
  vec3 s;
  vec3 t;
  vec3 n;
};

/// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
Frame frame_from_normal(vec3 n) {
  float sign = n.z < 0.0 ? -1.0 : 1.0;
  float a = -1.0 / (sign + n.z);
  float b = n.x * n.y * a;
  Frame f;
  f.s = vec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
  f.t = vec3(b, sign + n.y * n.y * a, -n.y);
  f.n = n;
  return f;
}

/// World to frame.
vec3 to_local(Frame f, vec3 v) { return vec3(dot3(v, f.s), dot3(v, f.t), dot3(v, f.n)); }

/// Frame to world.
vec3 to_world(Frame f, vec3 v) { return f.s * v.x + f.t * v.y + f.n * v.z; }

/// Origin of a ray that leaves the surface point p in direction d, moved along the geometric normal
/// to d's side by a bound of the rounding errors of p and of a later test against the same plane
/// (docs/reference/sampling.md, "Ray offset"). magnitude: the largest absolute coordinate of the
/// triangle's vertices.
vec3 offset_ray_origin(vec3 p, float magnitude, vec3 ng, vec3 d) {
  float distance = magnitude * 9.53674316e-7;  // 16 * 2^-24
  float side = dot3(d, ng) < 0.0 ? -1.0 : 1.0;
  return p + ng * (side * distance);
}

#endif
