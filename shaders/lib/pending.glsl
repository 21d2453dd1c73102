// The children of BVH nodes that a traversal has still to visit: a stack of one entry a level of
// the tree.
#ifndef FACET_PENDING_GLSL
#define FACET_PENDING_GLSL
#include "specialization.glsl"

/// Entries, the top first; 0 where there is none. An entry is a node's header above a list of up to
/// three of its children: two bits each, the next one lowest, under a leading 1. In registers that
/// shift, and no array: lavapipe stores to an array lane by lane, with a branch each, which took 60
/// % of the time of traversal. STACK_SIZE leaves only as many as the tree needs.
struct Pending {
  uint entries[LARGEST_STACK_SIZE + 1u];
};

const uint LIST_BITS = 7u;
const uint LIST_MASK = 127u;
const uint EMPTY_LIST = 1u;

/// M(1) to M(32): loops over the entries written out, since an index that is not constant makes an
/// array of memory.
// clang-format off
#define FACET_ENTRIES(M) \
  M(1) M(2) M(3) M(4) M(5) M(6) M(7) M(8) \
  M(9) M(10) M(11) M(12) M(13) M(14) M(15) M(16) \
  M(17) M(18) M(19) M(20) M(21) M(22) M(23) M(24) \
  M(25) M(26) M(27) M(28) M(29) M(30) M(31) M(32)
// clang-format on
#define FACET_CLEAR(i) p.entries[i] = 0u;
Pending nothing_pending() {
  Pending p;
  FACET_CLEAR(0)
  FACET_ENTRIES(FACET_CLEAR)
  return p;
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

/// Where a traversal is: an item of the BVH, marked if it is a leaf.
const uint LEAF = 0x80000000u;
const uint NOWHERE = 0xffffffffu;

bool is_leaf(uint place) { return (place & LEAF) != 0u; }
uint leaf_item(uint place) { return place & ~LEAF; }
uint child_place(uint header, uint child) {
  uint item = (header >> HEADER_INNER_BITS) * BLOCK_SIZE + child;
  return child >= (header & HEADER_INNER_MASK) ? item | LEAF : item;
}

// Below the last entry lies one that is always 0. Upwards, the last comes first.
#define FACET_UP(i) \
  if (STACK_SIZE > uint(i)) p.entries[i] = which ? p.entries[i - 1] : p.entries[i];
#define FACET_DOWN(i) \
  if (STACK_SIZE >= uint(i)) p.entries[i - 1] = which ? p.entries[i] : p.entries[i - 1];

/// Puts an entry on top where `which`.
void push(inout Pending p, bool which, uint entry) {
  // clang-format off
  FACET_UP(31) FACET_UP(30) FACET_UP(29) FACET_UP(28) FACET_UP(27) FACET_UP(26) FACET_UP(25)
  FACET_UP(24) FACET_UP(23) FACET_UP(22) FACET_UP(21) FACET_UP(20) FACET_UP(19) FACET_UP(18)
  FACET_UP(17) FACET_UP(16) FACET_UP(15) FACET_UP(14) FACET_UP(13) FACET_UP(12) FACET_UP(11)
  FACET_UP(10) FACET_UP(9) FACET_UP(8) FACET_UP(7) FACET_UP(6) FACET_UP(5) FACET_UP(4)
  FACET_UP(3) FACET_UP(2) FACET_UP(1)
      // clang-format on
      p.entries[0] = which ? entry : p.entries[0];
}

/// Removes the top entry where `which`.
void pop(inout Pending p, bool which){FACET_ENTRIES(FACET_DOWN)}

/// The next pending child, NOWHERE without one; takes it off where `which`.
uint take_pending(inout Pending p, bool which) {
  uint top = p.entries[0];
  uint header = top >> LIST_BITS;
  uint rest = without_next(top & LIST_MASK);
  p.entries[0] = which ? (header << LIST_BITS) | rest : top;
  pop(p, which && rest <= EMPTY_LIST);
  return top == 0u ? NOWHERE : child_place(header, next_of(top));
}

/// What comes after a node: the first of its children that the ray meets, while the others wait, or
/// else the next pending child.
uint take_next(inout Pending p, uint header, ChildList children) {
  uint next = take_pending(p, !children.any);
  push(p, children.any && children.rest > EMPTY_LIST, (header << LIST_BITS) | children.rest);
  return children.any ? child_place(header, children.first) : next;
}

#endif
