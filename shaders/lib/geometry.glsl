// The BVH's items, and the two tests of traversal.
#ifndef FACET_GEOMETRY_GLSL
#define FACET_GEOMETRY_GLSL
#include "records.glsl"
#include "frame.glsl"

BvhNode fetch_node(uint item) {
  return BvhNode(item_texel(3u * item), item_texel(3u * item + 1u), item_texel(3u * item + 2u));
}

/// Corners of an item's triangles, world space.
struct Corners {
  vec3 c0;
  vec3 c1;
  vec3 c2;
  vec3 c3;
};

Corners fetch_corners(uint item) {
  vec4 a = uintBitsToFloat(item_texel(3u * item));
  vec4 b = uintBitsToFloat(item_texel(3u * item + 1u));
  vec4 c = uintBitsToFloat(item_texel(3u * item + 2u));
  return Corners(a.xyz, vec3(a.w, b.xy), vec3(b.zw, c.x), c.yzw);
}

vec3 corner(Corners p, uint k) {
  vec3 low = k == 0u ? p.c0 : p.c1;
  vec3 high = k == 2u ? p.c2 : p.c3;
  return k < 2u ? low : high;
}

/// What a triangle is in the scene.
struct TriangleName {
  uint index;  // in order of reading
  uint mesh;
  uint corners;  // two bits a vertex: which corner of the item it is
};

TriangleName triangle_name(uint triangle) {
  PairRecord pair = fetch_pair(triangle >> 1u);
  bool second = (triangle & 1u) != 0u;
  uint name = second ? pair.name1 : pair.name0;
  return TriangleName(name & NAME_INDEX_MASK, second ? pair.mesh1 : pair.mesh0,
                      name >> NAME_INDEX_BITS);
}

/// Vertices of a triangle in order of reading, world space.
struct Vertices {
  vec3 v0;
  vec3 v1;
  vec3 v2;
};

/// names: the triangle's TriangleName.corners.
Vertices fetch_vertices(uint triangle, uint names) {
  Corners corners = fetch_corners(triangle >> 1u);
  return Vertices(corner(corners, names & 3u), corner(corners, (names >> 2u) & 3u),
                  corner(corners, names >> 4u));
}

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

vec4 unpack_bytes(uint w) { return vec4(uvec4(w, w >> 8u, w >> 16u, w >> 24u) & 255u); }

/// Distance at which the ray enters each child of a node, LARGEST where it misses the child.
/// Conservative: planes are moved outwards by a bound of all rounding errors of this test and of
/// the triangle test, 2^-19 of the coordinate differences involved (after T. Ize, "Robust BVH Ray
/// Traversal", JCGT 2(2), 2013). Distances are compared as integers, which order alike from t_min
/// on, since that is not negative; min and max of floats cost lavapipe three instructions each, for
/// NaN's sake. Nothing here overflows while coordinates stay below 1e20.
vec4 intersect_children(TraversalRay ray, BvhNode node, float t_max) {
  uint e = node.origin_exponents.w;
  vec3 scale = uintBitsToFloat(uvec3(e & 255u, (e >> 8u) & 255u, (e >> 16u) & 255u) << 23u);
  vec3 base = uintBitsToFloat(node.origin_exponents.xyz) - ray.origin;
  vec3 reach = abs(base) + 256.0 * scale;
  vec3 slack = (reach.x + reach.y + reach.z) * ray.slack;
  vec3 step = scale * ray.inverse;
  vec3 middle = base * ray.inverse;
  vec3 near_base = middle - slack;
  vec3 far_base = middle + slack;
  uvec3 lower = node.lower_header.xyz;
  uvec3 upper = node.upper.xyz;
  bvec3 backwards = lessThan(ray.inverse, vec3(0.0));
  uvec3 near_planes = uvec3(backwards.x ? upper.x : lower.x, backwards.y ? upper.y : lower.y,
                            backwards.z ? upper.z : lower.z);
  uvec3 far_planes = uvec3(backwards.x ? lower.x : upper.x, backwards.y ? lower.y : upper.y,
                           backwards.z ? lower.z : upper.z);
  ivec4 t_near = max(floatBitsToInt(unpack_bytes(near_planes.z) * step.z + near_base.z),
                     ivec4(floatBitsToInt(ray.t_min)));
  t_near = max(floatBitsToInt(unpack_bytes(near_planes.y) * step.y + near_base.y), t_near);
  t_near = max(floatBitsToInt(unpack_bytes(near_planes.x) * step.x + near_base.x), t_near);
  ivec4 t_far = min(floatBitsToInt(unpack_bytes(far_planes.z) * step.z + far_base.z),
                    ivec4(floatBitsToInt(t_max)));
  t_far = min(floatBitsToInt(unpack_bytes(far_planes.y) * step.y + far_base.y), t_far);
  t_far = min(floatBitsToInt(unpack_bytes(far_planes.x) * step.x + far_base.x), t_far);
  return mix(vec4(LARGEST), intBitsToFloat(t_near), lessThanEqual(t_near, t_far));
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
/// errors grow with the triangle's length over its width (docs/sampling.md, "Intersection").
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
