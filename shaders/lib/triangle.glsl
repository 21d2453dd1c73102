// Triangles by their corners, wherever these come from: normals, points, and what a ray meets.
#ifndef FACET_TRIANGLE_GLSL
#define FACET_TRIANGLE_GLSL
#include "../shared/records.h"
#include "frame.glsl"

/// Unit normal of a triangle by its winding. Of two edges that are almost parallel only their
/// perpendicular parts count, so that no digits cancel; the product of others has all digits as it
/// is, and components that are 0 by symmetry stay so.
vec3 triangle_normal(vec3 v0, vec3 v1, vec3 v2) {
  vec3 to_v2 = v2 - v0;
  vec3 opposite = v2 - v1;
  vec3 e = normalize_safe(v1 - v0);
  // The shorter one: of a needle's two long edges, neither tells much of its width.
  vec3 f = normalize_safe(dot3(to_v2, to_v2) <= dot3(opposite, opposite) ? to_v2 : opposite);
  vec3 n = cross3(e, f);
  vec3 of_thin = cross3(e, f - dot3(e, f) * e);
  return normalize_safe(dot3(n, n) < 0.01 ? of_thin : n);
}

/// Corners of an item's triangles, world space.
struct Corners {
  vec3 c0;
  vec3 c1;
  vec3 c2;
  vec3 c3;
};

/// A ray prepared for the tests.
struct TraversalRay {
  vec3 origin;
  float t_min;
  vec3 inverse;  // 1/direction, finite
  float t_max;
  vec3 slack;  // |inverse| times the bound of relative errors of positions
  vec3 direction;
  Frame across;  // s, t: unit vectors perpendicular to the ray
};

TraversalRay traversal_ray(RayRecord r) {
  TraversalRay ray;
  ray.origin = r.origin.xyz;
  ray.t_min = r.origin.w;
  ray.t_max = r.direction.w;
  vec3 d = r.direction.xyz;
  vec3 unit = normalize_safe(d);
  float length = dot3(d, unit);
  ray.across = frame_from_normal(unit);
  ray.direction = d;
  // Directions almost parallel to a slab count as parallel to it within the bound that
  // intersect_children adds.
  vec3 smallest = vec3(1.0e-15 * length);
  vec3 clamped = mix(max(d, smallest), min(d, -smallest), lessThan(d, vec3(0.0)));
  ray.inverse = vec3(1.0) / clamped;
  ray.slack = abs(ray.inverse) * 1.90734863e-6;
  return ray;
}

/// A hit of a pair's triangles.
struct PairHit {
  bool found;
  bool second;  // of the two
  float t;
  float b1;  // weight of corner 1 in the first triangle, of corner 2 in the second
  float b2;  // of corner 2, of corner 3
};

/// Twice the signed area of the triangle of the origin, p and q.
float edge_function(vec2 p, vec2 q) { return p.x * q.y - p.y * q.x; }

bool same_side(float u, float v, float w) {
  return min(u, min(v, w)) >= 0.0 || max(u, max(v, w)) <= 0.0;
}

/// A normal of the plane of the edges e and f; inverse_e is e/|e|^2. It is formed with f's part
/// perpendicular to e, so that no digits cancel in the cross product however thin the triangle is:
/// all vertices lie within a few ulps of the longest edge from the plane. No more than squares of
/// lengths has to be within a float's range.
vec3 plane_normal(vec3 e, vec3 inverse_e, vec3 f) {
  return cross3(f - dot3(f, inverse_e) * e, inverse_e);
}

/// The nearest hit of the ray with a pair's triangles at t_min < t < t_max.
/// Whether there is a hit is watertight: the vertices are projected along the ray, alike for every
/// triangle that shares them, and an edge's function changes only its sign between the two
/// triangles beside it (after S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection",
/// JCGT 2(1), 2013). Where it lies along the ray is told by the plane, not by the weights, whose
/// errors grow with the triangle's length over its width (docs/reference/sampling.md,
/// "Intersection").
PairHit intersect_pair(TraversalRay ray, Corners corners, float t_max) {
  vec3 a = corners.c0 - ray.origin;
  vec3 b = corners.c1 - ray.origin;
  vec3 c = corners.c2 - ray.origin;
  vec3 d = corners.c3 - ray.origin;
  vec2 pa = vec2(dot3(ray.across.s, a), dot3(ray.across.t, a));
  vec2 pb = vec2(dot3(ray.across.s, b), dot3(ray.across.t, b));
  vec2 pc = vec2(dot3(ray.across.s, c), dot3(ray.across.t, c));
  vec2 pd = vec2(dot3(ray.across.s, d), dot3(ray.across.t, d));
  float diagonal = edge_function(pa, pc);
  vec3 e = corners.c2 - corners.c0;
  vec3 inverse_e = e * (1.0 / dot3(e, e));

  float u0 = edge_function(pc, pb);
  float w0 = edge_function(pb, pa);
  float det0 = (u0 + diagonal) + w0;
  vec3 n0 = plane_normal(e, inverse_e, corners.c1 - corners.c0);
  float t0 = dot3(n0, a) / dot3(n0, ray.direction);
  bool hit0 = same_side(u0, diagonal, w0) && det0 != 0.0 && t0 > ray.t_min && t0 < t_max;

  float u1 = edge_function(pd, pc);
  float v1 = edge_function(pa, pd);
  float det1 = (u1 + v1) - diagonal;
  vec3 n1 = plane_normal(e, inverse_e, corners.c3 - corners.c0);
  float t1 = dot3(n1, a) / dot3(n1, ray.direction);
  bool hit1 =
      same_side(u1, v1, -diagonal) && det1 != 0.0 && t1 > ray.t_min && t1 < (hit0 ? t0 : t_max);

  PairHit hit;
  hit.found = hit0 || hit1;
  hit.second = hit1;
  hit.t = hit1 ? t1 : t0;
  float inverse = 1.0 / (hit1 ? det1 : det0);
  hit.b1 = (hit1 ? v1 : diagonal) * inverse;
  hit.b2 = (hit1 ? -diagonal : w0) * inverse;
  return hit;
}

#endif
