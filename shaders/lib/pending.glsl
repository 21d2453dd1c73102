// The children of BVH nodes that a traversal has still to visit: a stack of one entry a level of the tree.
#ifndef FACET_PENDING_GLSL
#define FACET_PENDING_GLSL
#include "specialization.glsl"

/// Entries, the top first; 0 where there is none. An entry is a node's header above a list of up to three of its children: two
/// bits each, the next one lowest, under a leading 1.
/// In registers that shift, and no array: lavapipe stores to an array lane by lane, with a branch each, which took 60 % of
/// the time of traversal. STACK_SIZE leaves only as many as the tree needs.
struct Pending {
  uvec4 a;
  uvec4 b;
  uvec4 c;
  uvec4 d;
  uvec4 e;
  uvec4 f;
  uvec4 g;
  uvec4 h;
};

const uint LIST_BITS = 7u;
const uint LIST_MASK = 127u;
const uint EMPTY_LIST = 1u;

Pending nothing_pending() {
  return Pending(uvec4(0u), uvec4(0u), uvec4(0u), uvec4(0u), uvec4(0u), uvec4(0u), uvec4(0u), uvec4(0u));
}

uint with_next(uint list, uint child) { return (list << 2u) | child; }
uint next_of(uint list) { return list & 3u; }
uint without_next(uint list) { return list >> 2u; }

/// Children of one node that a ray meets.
struct ChildList {
  bool any;
  uint first;  // where there is any
  uint rest;   // list of the others
};

/// Where a traversal is: an item of the BVH, marked if it is a leaf's first triangle.
const uint ROOT = 0u;
const uint LEAF = 0x80000000u;
const uint NOWHERE = 0xffffffffu;

bool is_leaf(uint place) { return (place & LEAF) != 0u; }
uint leaf_item(uint place) { return place & ~LEAF; }
uint child_place(uint header, uint child) {
  uint item = (header >> HEADER_INNER_BITS) * BLOCK_SIZE + child;
  return child >= (header & HEADER_INNER_MASK) ? item | LEAF : item;
}

/// Puts an entry on top where `which`.
void push(inout Pending p, bool which, uint entry) {
  if (STACK_SIZE > 28u) p.h = which ? uvec4(p.g.w, p.h.xyz) : p.h;
  if (STACK_SIZE > 24u) p.g = which ? uvec4(p.f.w, p.g.xyz) : p.g;
  if (STACK_SIZE > 20u) p.f = which ? uvec4(p.e.w, p.f.xyz) : p.f;
  if (STACK_SIZE > 16u) p.e = which ? uvec4(p.d.w, p.e.xyz) : p.e;
  if (STACK_SIZE > 12u) p.d = which ? uvec4(p.c.w, p.d.xyz) : p.d;
  if (STACK_SIZE > 8u) p.c = which ? uvec4(p.b.w, p.c.xyz) : p.c;
  if (STACK_SIZE > 4u) p.b = which ? uvec4(p.a.w, p.b.xyz) : p.b;
  p.a = which ? uvec4(entry, p.a.xyz) : p.a;
}

/// Removes the top entry where `which`.
void pop(inout Pending p, bool which) {
  p.a = which ? uvec4(p.a.yzw, p.b.x) : p.a;
  if (STACK_SIZE > 4u) p.b = which ? uvec4(p.b.yzw, p.c.x) : p.b;
  if (STACK_SIZE > 8u) p.c = which ? uvec4(p.c.yzw, p.d.x) : p.c;
  if (STACK_SIZE > 12u) p.d = which ? uvec4(p.d.yzw, p.e.x) : p.d;
  if (STACK_SIZE > 16u) p.e = which ? uvec4(p.e.yzw, p.f.x) : p.e;
  if (STACK_SIZE > 20u) p.f = which ? uvec4(p.f.yzw, p.g.x) : p.f;
  if (STACK_SIZE > 24u) p.g = which ? uvec4(p.g.yzw, p.h.x) : p.g;
  if (STACK_SIZE > 28u) p.h = which ? uvec4(p.h.yzw, 0u) : p.h;
}

/// The next pending child, NOWHERE without one; takes it off where `which`.
uint take_pending(inout Pending p, bool which) {
  uint top = p.a.x;
  uint header = top >> LIST_BITS;
  uint rest = without_next(top & LIST_MASK);
  p.a.x = which ? (header << LIST_BITS) | rest : top;
  pop(p, which && rest <= EMPTY_LIST);
  return top == 0u ? NOWHERE : child_place(header, next_of(top));
}

/// What comes after a node: the first of its children that the ray meets, while the others wait, or else the next pending child.
uint take_next(inout Pending p, uint header, ChildList children) {
  uint next = take_pending(p, !children.any);
  push(p, children.any && children.rest > EMPTY_LIST, (header << LIST_BITS) | children.rest);
  return children.any ? child_place(header, children.first) : next;
}

#endif
