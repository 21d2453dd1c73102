// The integer hash behind every random number (docs/sampling.md, "Numbers").
// Source: M. Jarzynski, M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020 (pcg4d).
#ifndef FACET_SHARED_RANDOM_HASH_H
#define FACET_SHARED_RANDOM_HASH_H
#include "types.h"
FACET_SHARED_BEGIN

/// Four well-mixed 32-bit words from four; a bijection of the 128 bits.
FACET_FUNCTION uvec4 pcg4d(uvec4 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  v ^= v >> 16u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  return v;
}

FACET_SHARED_END
#endif
