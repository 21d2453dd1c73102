// Traversal of the BVH: closest hit, and any hit. Every loop is bounded and tested at its top: Mesa 22's lavapipe has one
// budget of 65,535 loop iterations per subgroup, after which loops silently end, and loses values that leave a
// bottom-tested loop. A loop that ended early is recognised by what it left undone.
#ifndef FACET_TRAVERSAL_GLSL
#define FACET_TRAVERSAL_GLSL
#include "geometry.glsl"
#include "pending.glsl"

/// Iterations after which a traversal gives up and is counted in bound_hits.
const uint TRAVERSAL_BOUND = 60000u;

/// Children that the ray meets, in the order in which it enters them. t: where it enters each, LARGEST for those it misses.
/// Sorted as integers whose two lowest bits are the child: alike but for a quarter of a millionth, and half the work.
ChildList sorted_children(vec4 t) {
  uvec4 k = (floatBitsToUint(t) & ~3u) | uvec4(0u, 1u, 2u, 3u);
  uvec2 low = min(k.xz, k.yw);
  uvec2 high = max(k.xz, k.yw);
  uint first = min(low.x, low.y);
  uint fourth = max(high.x, high.y);
  uint second = min(max(low.x, low.y), min(high.x, high.y));
  uint third = max(max(low.x, low.y), min(high.x, high.y));
  uint missed = floatBitsToUint(LARGEST) & ~3u;
  uint rest = fourth < missed ? with_next(EMPTY_LIST, fourth & 3u) : EMPTY_LIST;
  rest = third < missed ? with_next(rest, third & 3u) : rest;
  rest = second < missed ? with_next(rest, second & 3u) : rest;
  return ChildList(first < missed, first & 3u, rest);
}

/// Nearest hit with t_min < t < t_max, or with `any` the first that is found; triangle NONE for a miss. complete: false where
/// the bound was reached.
HitRecord trace(RayRecord record, bool any, out bool complete) {
  TraversalRay ray = traversal_ray(record);
  HitRecord hit = HitRecord(ray.t_max, NONE, 0.0, 0.0);
  Pending pending = nothing_pending();
  uint place = ROOT;
  uint steps = 0u;
  complete = true;
  while (place != NOWHERE && steps < TRAVERSAL_BOUND) {
    while (!is_leaf(place) && steps < TRAVERSAL_BOUND) {
      BvhNode node = fetch_node(place);
      place = take_next(pending, node.lower_header.w, sorted_children(intersect_children(ray, node, hit.t)));
      ++steps;
    }
    bool at_leaf = is_leaf(place) && place != NOWHERE;
    uint item = at_leaf ? leaf_item(place) : 0u;
    while (item != 0u) {
      TriangleRecord triangle = fetch_triangle(item);
      vec3 t_b1_b2;
      bool inside = intersect_triangle(ray, triangle, hit.t, t_b1_b2);
      hit.t = inside ? t_b1_b2.x : hit.t;
      hit.b1 = inside ? t_b1_b2.y : hit.b1;
      hit.b2 = inside ? t_b1_b2.z : hit.b2;
      hit.triangle = inside ? item : hit.triangle;
      item = triangle.v2.w;
    }
    complete = complete && item == 0u;
    uint next = take_pending(pending, at_leaf);
    place = at_leaf ? next : place;
    if (any) place = hit.triangle != NONE ? NOWHERE : place;
    ++steps;
  }
  complete = complete && place == NOWHERE;
  return hit;
}

HitRecord trace_closest(RayRecord record, out bool complete) { return trace(record, false, complete); }

/// Whether anything is hit with t_min < t < t_max.
bool trace_any(RayRecord record, out bool complete) { return trace(record, true, complete).triangle != NONE; }

#endif
