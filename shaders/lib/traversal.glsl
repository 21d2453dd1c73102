// Traversal of the BVH: closest hit, and any hit. Every loop is bounded and tested at its top: Mesa 22's lavapipe has one
// budget of 65,535 loop iterations per subgroup, after which loops silently end, and loses values that leave a
// bottom-tested loop. A loop that ended early is recognised by what it left undone.
#ifndef FACET_TRAVERSAL_GLSL
#define FACET_TRAVERSAL_GLSL
#include "geometry.glsl"
#include "pending.glsl"

/// Iterations after which a traversal gives up and is counted in bound_hits.
const uint TRAVERSAL_BOUND = 60000u;

bool is_leaf(uint reference) { return (reference & REFERENCE_LEAF) != 0u; }
uint leaf_count(uint reference) { return (reference >> REFERENCE_COUNT_SHIFT) & REFERENCE_COUNT_MASK; }
uint leaf_first(uint reference) { return reference & REFERENCE_FIRST_MASK; }

/// Children in the order in which the ray enters them, as a list; t: where it enters each, LARGEST for those it misses.
/// Sorted as integers whose two lowest bits are the child: alike but for a quarter of a millionth, and half the work.
uint sorted_children(vec4 t) {
  uvec4 k = (floatBitsToUint(t) & ~3u) | uvec4(0u, 1u, 2u, 3u);
  uvec2 low = min(k.xz, k.yw);
  uvec2 high = max(k.xz, k.yw);
  uint first = min(low.x, low.y);
  uint fourth = max(high.x, high.y);
  uint second = min(max(low.x, low.y), min(high.x, high.y));
  uint third = max(max(low.x, low.y), min(high.x, high.y));
  uint missed = floatBitsToUint(LARGEST) & ~3u;
  uint list = fourth < missed ? with_next(EMPTY_LIST, fourth & 3u) : EMPTY_LIST;
  list = third < missed ? with_next(list, third & 3u) : list;
  list = second < missed ? with_next(list, second & 3u) : list;
  return first < missed ? with_next(list, first & 3u) : list;
}

/// Reference of a node's child.
uint fetch_reference(uint node, uint child) {
  uvec4 children = node_texel(4u * node + 1u);
  uint low = child == 0u ? children.x : children.y;
  uint high = child == 2u ? children.z : children.w;
  return child < 2u ? low : high;
}

/// Reference of the next pending child, REFERENCE_DONE without one; takes it where `which`.
uint take_pending(inout Pending p, bool which) {
  uint top = p.a.x;
  uint reference = fetch_reference(entry_node(top), next_of(top));
  drop_next(p, which);
  return top == 0u ? REFERENCE_DONE : reference;
}

/// Reference of what comes after a node of which the ray meets the children of the list: the first of them, while the
/// others wait, or else the next pending child.
uint take_next(inout Pending p, uint node, uint list) {
  bool meets = list != EMPTY_LIST;
  uint top = p.a.x;
  uint reference = fetch_reference(meets ? node : entry_node(top), next_of(meets ? list : top));
  drop_next(p, !meets);
  uint left = without_next(list);
  push(p, left > EMPTY_LIST, pending_entry(node, left));
  return meets || top != 0u ? reference : REFERENCE_DONE;
}

/// Nearest hit with t_min < t < t_max, or with `any` the first that is found; triangle NONE for a miss. complete: false where
/// the bound was reached.
HitRecord trace(RayRecord record, bool any, out bool complete) {
  TraversalRay ray = traversal_ray(record);
  HitRecord hit = HitRecord(ray.t_max, NONE, 0.0, 0.0);
  Pending pending = nothing_pending();
  uint reference = 0u;
  uint steps = 0u;
  complete = true;
  while (reference != REFERENCE_DONE && steps < TRAVERSAL_BOUND) {
    while (!is_leaf(reference) && steps < TRAVERSAL_BOUND) {
      uint list = sorted_children(intersect_children(ray, reference, hit.t));
      reference = take_next(pending, reference, list);
      ++steps;
    }
    bool at_leaf = is_leaf(reference) && reference != REFERENCE_DONE;
    uint count = at_leaf ? leaf_count(reference) : 0u;
    uint first = leaf_first(reference);
    uint k = 0u;
    while (k < count) {
      vec3 t_b1_b2;
      bool inside = intersect_triangle(ray, first + k, hit.t, t_b1_b2);
      hit.t = inside ? t_b1_b2.x : hit.t;
      hit.b1 = inside ? t_b1_b2.y : hit.b1;
      hit.b2 = inside ? t_b1_b2.z : hit.b2;
      hit.triangle = inside ? first + k : hit.triangle;
      ++k;
    }
    complete = complete && k == count;
    uint next = take_pending(pending, at_leaf);
    reference = at_leaf ? next : reference;
    if (any) reference = hit.triangle != NONE ? REFERENCE_DONE : reference;
    ++steps;
  }
  complete = complete && reference == REFERENCE_DONE;
  return hit;
}

HitRecord trace_closest(RayRecord record, out bool complete) { return trace(record, false, complete); }

/// Whether anything is hit with t_min < t < t_max.
bool trace_any(RayRecord record, out bool complete) { return trace(record, true, complete).triangle != NONE; }

#endif
