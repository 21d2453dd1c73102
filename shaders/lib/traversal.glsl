// Traversal of the BVH: closest hit, and any hit. Every loop is bounded and tested at its top: Mesa
// 22's lavapipe has one budget of 65,535 loop iterations per subgroup, after which loops silently
// end, and loses values that leave a bottom-tested loop. A loop that ended early is recognised by
// what it left undone.
#ifndef FACET_TRAVERSAL_GLSL
#define FACET_TRAVERSAL_GLSL
#include "geometry.glsl"
#include "pending.glsl"

/// Iterations after which a traversal gives up and is counted in bound_hits: a bounce has two of
/// them.
const uint TRAVERSAL_BOUND = 30000u;

/// Children that the ray meets, in the order in which it enters them. t: where it enters each,
/// LARGEST for those it misses. Sorted as integers whose two lowest bits are the child: alike but
/// for a quarter of a millionth, and half the work.
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

/// Nearest hit with t_min < t < t_max, or with `any` the first that is found; triangle NONE for a
/// miss. The weights are those of a PairHit. complete: false where the bound was reached.
HitRecord trace(RayRecord record, bool any, out bool complete) {
  TraversalRay ray = traversal_ray(record);
  HitRecord hit = HitRecord(ray.t_max, NONE, 0.0, 0.0);
  Pending pending = nothing_pending();
  uint place = ROOT_ITEM;
  uint steps = 0u;
  complete = true;
  while (place != NOWHERE && steps < TRAVERSAL_BOUND) {
    while (!is_leaf(place) && steps < TRAVERSAL_BOUND) {
      BvhNode node = fetch_node(place);
      place = take_next(pending, node.lower_header.w,
                        sorted_children(intersect_children(ray, node, hit.t)));
      ++steps;
    }
    bool at_leaf = is_leaf(place) && place != NOWHERE;
    uint item = at_leaf ? leaf_item(place) : 0u;
    PairHit pair = intersect_pair(ray, fetch_corners(item), hit.t);
    bool closer = at_leaf && pair.found;
    hit.t = closer ? pair.t : hit.t;
    hit.b1 = closer ? pair.b1 : hit.b1;
    hit.b2 = closer ? pair.b2 : hit.b2;
    hit.triangle = closer ? 2u * item + (pair.second ? 1u : 0u) : hit.triangle;
    uint next = take_pending(pending, at_leaf);
    place = at_leaf ? next : place;
    if (any) place = hit.triangle != NONE ? NOWHERE : place;
    ++steps;
  }
  complete = complete && place == NOWHERE;
  return hit;
}

/// The hit with the weights of the second and third vertex in order of reading, as all else counts
/// them.
HitRecord in_order_of_reading(HitRecord hit) {
  bool missed = hit.triangle == NONE;
  uint corners = triangle_name(missed ? 0u : hit.triangle).corners;
  float b0 = (1.0 - hit.b1) - hit.b2;
  bool second = (hit.triangle & 1u) != 0u;
  vec4 weights = second ? vec4(b0, 0.0, hit.b1, hit.b2) : vec4(b0, hit.b1, hit.b2, 0.0);
  hit.b1 = missed ? 0.0 : component(weights, (corners >> 2u) & 3u);
  hit.b2 = missed ? 0.0 : component(weights, corners >> 4u);
  return hit;
}

/// As trace; the weights are those of the second and third vertex in order of reading.
HitRecord trace_closest(RayRecord record, out bool complete) {
  return in_order_of_reading(trace(record, false, complete));
}

/// Whether anything is hit with t_min < t < t_max.
bool trace_any(RayRecord record, out bool complete) {
  return trace(record, true, complete).triangle != NONE;
}

#endif
