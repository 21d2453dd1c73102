// The BVH's items, and the ray's test against their boxes.
#ifndef FACET_GEOMETRY_GLSL
#define FACET_GEOMETRY_GLSL
#include "records.glsl"
#include "triangle.glsl"

BvhNode fetch_node(uint item) {
  return BvhNode(item_texel(3u * item), item_texel(3u * item + 1u), item_texel(3u * item + 2u));
}

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

#endif
