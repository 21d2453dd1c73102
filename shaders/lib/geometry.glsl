// Fetches of the BVH's items, and the two tests of traversal. The one build variant of the kernels is here: texel
// buffers, read as images (the fast load of lavapipe, inlined, unlike texelFetch), or, where a device's are too small, storage
// buffers.
#ifndef FACET_GEOMETRY_GLSL
#define FACET_GEOMETRY_GLSL
#include "../shared/bindings.h"
#include "../shared/records.h"
#include "frame.glsl"

#ifdef FACET_NO_TEXEL_BUFFERS
layout(std430, binding = BINDING_BVH) readonly buffer BvhItems { uvec4 bvh_texels[]; };
uvec4 bvh_texel(uint i) { return bvh_texels[i]; }
#else
layout(binding = BINDING_BVH, rgba32ui) uniform readonly uimageBuffer bvh_texels;
uvec4 bvh_texel(uint i) { return imageLoad(bvh_texels, int(i)); }
#endif

BvhNode fetch_node(uint item) { return BvhNode(bvh_texel(3u * item), bvh_texel(3u * item + 1u), bvh_texel(3u * item + 2u)); }

TriangleRecord fetch_triangle(uint item) {
  return TriangleRecord(bvh_texel(3u * item), bvh_texel(3u * item + 1u), bvh_texel(3u * item + 2u));
}

/// Position kept in a triangle's texel, world space.
vec3 vertex_position(uvec4 texel) { return uintBitsToFloat(texel.xyz); }

/// A ray prepared for the tests.
struct TraversalRay {
  vec3 origin;
  float t_min;
  vec3 inverse;  // 1/direction, finite
  float t_max;
  vec3 slack;    // |inverse| times the bound of relative errors of positions
  Frame across;  // s, t: unit vectors perpendicular to the ray; n: direction / |direction|^2
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
  ray.across.n = unit / length;
  // Directions almost parallel to a slab count as parallel to it within the bound that intersect_children adds.
  vec3 smallest = vec3(1.0e-15 * length);
  vec3 clamped = mix(max(d, smallest), min(d, -smallest), lessThan(d, vec3(0.0)));
  ray.inverse = vec3(1.0) / clamped;
  ray.slack = abs(ray.inverse) * 1.90734863e-6;
  return ray;
}

vec4 unpack_bytes(uint w) { return vec4(uvec4(w, w >> 8u, w >> 16u, w >> 24u) & 255u); }

/// Distance at which the ray enters each child of a node, LARGEST where it misses the child. Conservative: planes are moved
/// outwards by a bound of all rounding errors of this test and of the triangle test, 2^-19 of the coordinate differences
/// involved (after T. Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013). Distances are compared as integers, which order alike
/// from t_min on, since that is not negative; min and max of floats cost lavapipe three instructions each, for NaN's sake. Nothing
/// here overflows while coordinates stay below 1e20.
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
  uvec3 near_planes = uvec3(backwards.x ? upper.x : lower.x, backwards.y ? upper.y : lower.y, backwards.z ? upper.z : lower.z);
  uvec3 far_planes = uvec3(backwards.x ? lower.x : upper.x, backwards.y ? lower.y : upper.y, backwards.z ? lower.z : upper.z);
  ivec4 t_near = max(floatBitsToInt(unpack_bytes(near_planes.z) * step.z + near_base.z), ivec4(floatBitsToInt(ray.t_min)));
  t_near = max(floatBitsToInt(unpack_bytes(near_planes.y) * step.y + near_base.y), t_near);
  t_near = max(floatBitsToInt(unpack_bytes(near_planes.x) * step.x + near_base.x), t_near);
  ivec4 t_far = min(floatBitsToInt(unpack_bytes(far_planes.z) * step.z + far_base.z), ivec4(floatBitsToInt(t_max)));
  t_far = min(floatBitsToInt(unpack_bytes(far_planes.y) * step.y + far_base.y), t_far);
  t_far = min(floatBitsToInt(unpack_bytes(far_planes.x) * step.x + far_base.x), t_far);
  return mix(vec4(LARGEST), intBitsToFloat(t_near), lessThanEqual(t_near, t_far));
}

/// The ray against a triangle. Returns (t, b1, b2) and whether it is hit at t_min < t < t_max.
/// Watertight: the vertices are projected along the ray, alike for every triangle that shares them, and an edge's
/// function changes only its sign between the two triangles beside it
/// (after S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013).
bool intersect_triangle(TraversalRay ray, TriangleRecord triangle, float t_max, out vec3 t_b1_b2) {
  vec3 a = vertex_position(triangle.v0) - ray.origin;
  vec3 b = vertex_position(triangle.v1) - ray.origin;
  vec3 c = vertex_position(triangle.v2) - ray.origin;
  vec2 pa = vec2(dot3(ray.across.s, a), dot3(ray.across.t, a));
  vec2 pb = vec2(dot3(ray.across.s, b), dot3(ray.across.t, b));
  vec2 pc = vec2(dot3(ray.across.s, c), dot3(ray.across.t, c));
  float u = pc.x * pb.y - pc.y * pb.x;
  float v = pa.x * pc.y - pa.y * pc.x;
  float w = pb.x * pa.y - pb.y * pa.x;
  float det = (u + v) + w;
  float inverse = 1.0 / det;
  float t = ((u * dot3(ray.across.n, a) + v * dot3(ray.across.n, b)) + w * dot3(ray.across.n, c)) * inverse;
  t_b1_b2 = vec3(t, v * inverse, w * inverse);
  bool inside = min(u, min(v, w)) >= 0.0 || max(u, max(v, w)) <= 0.0;
  return inside && det != 0.0 && t > ray.t_min && t < t_max;
}

#endif
