// Traversal of the BVH: closest hit, and any hit. Every loop is bounded and tested at its top: Mesa 22's lavapipe has one
// budget of 65,535 loop iterations per subgroup, after which loops silently end, and loses values that leave a
// bottom-tested loop. A loop that ended early is recognised by what it left undone.
#ifndef FACET_TRAVERSAL_GLSL
#define FACET_TRAVERSAL_GLSL
#include "geometry.glsl"
#include "specialization.glsl"

/// Iterations after which a traversal gives up and is counted in bound_hits.
const uint TRAVERSAL_BOUND = 60000u;

bool is_leaf(uint reference) { return (reference & REFERENCE_LEAF) != 0u; }
uint leaf_count(uint reference) { return (reference >> REFERENCE_COUNT_SHIFT) & REFERENCE_COUNT_MASK; }
uint leaf_first(uint reference) { return reference & REFERENCE_FIRST_MASK; }

/// Exchanges two children where the second is nearer.
void order(inout float ta, inout uint ra, inout float tb, inout uint rb) {
  bool swap = tb < ta;
  float t = swap ? tb : ta;
  uint r = swap ? rb : ra;
  tb = swap ? ta : tb;
  rb = swap ? ra : rb;
  ta = t;
  ra = r;
}

/// Nearest hit with t_min < t < t_max; triangle NONE for a miss. complete: false where the bound was reached.
HitRecord trace_closest(RayRecord record, out bool complete) {
  TraversalRay ray = traversal_ray(record);
  HitRecord hit = HitRecord(ray.t_max, NONE, 0.0, 0.0);
  uint stack[STACK_SIZE];
  stack[0] = REFERENCE_DONE;
  uint sp = 1u;
  uint reference = 0u;
  uint steps = 0u;
  complete = true;
  while (reference != REFERENCE_DONE && steps < TRAVERSAL_BOUND) {
    while (!is_leaf(reference) && steps < TRAVERSAL_BOUND) {
      BvhNode node = fetch_node(reference);
      vec4 t = intersect_children(ray, node, hit.t);
      uvec4 r = node.children;
      order(t.x, r.x, t.y, r.y);
      order(t.z, r.z, t.w, r.w);
      order(t.x, r.x, t.z, r.z);
      order(t.y, r.y, t.w, r.w);
      order(t.y, r.y, t.z, r.z);
      stack[sp] = r.w;
      sp += uint(t.w < LARGEST);
      stack[sp] = r.z;
      sp += uint(t.z < LARGEST);
      stack[sp] = r.y;
      sp += uint(t.y < LARGEST);
      stack[sp] = r.x;
      sp += uint(t.x < LARGEST);
      --sp;
      reference = stack[sp];
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
    sp -= uint(at_leaf);
    reference = at_leaf ? stack[sp] : reference;
    ++steps;
  }
  complete = complete && reference == REFERENCE_DONE;
  return hit;
}

/// Whether anything is hit with t_min < t < t_max.
bool trace_any(RayRecord record, out bool complete) {
  TraversalRay ray = traversal_ray(record);
  uint stack[STACK_SIZE];
  stack[0] = REFERENCE_DONE;
  uint sp = 1u;
  uint reference = 0u;
  uint steps = 0u;
  bool found = false;
  complete = true;
  while (reference != REFERENCE_DONE && steps < TRAVERSAL_BOUND) {
    while (!is_leaf(reference) && steps < TRAVERSAL_BOUND) {
      BvhNode node = fetch_node(reference);
      vec4 t = intersect_children(ray, node, ray.t_max);
      stack[sp] = node.children.w;
      sp += uint(t.w < LARGEST);
      stack[sp] = node.children.z;
      sp += uint(t.z < LARGEST);
      stack[sp] = node.children.y;
      sp += uint(t.y < LARGEST);
      stack[sp] = node.children.x;
      sp += uint(t.x < LARGEST);
      --sp;
      reference = stack[sp];
      ++steps;
    }
    bool at_leaf = is_leaf(reference) && reference != REFERENCE_DONE;
    uint count = at_leaf ? leaf_count(reference) : 0u;
    uint first = leaf_first(reference);
    uint k = 0u;
    while (k < count) {
      vec3 t_b1_b2;
      found = intersect_triangle(ray, first + k, ray.t_max, t_b1_b2) || found;
      ++k;
    }
    complete = complete && k == count;
    sp -= uint(at_leaf);
    reference = at_leaf ? stack[sp] : reference;
    reference = found ? REFERENCE_DONE : reference;
    ++steps;
  }
  complete = found || (complete && reference == REFERENCE_DONE);
  return found;
}

#endif
