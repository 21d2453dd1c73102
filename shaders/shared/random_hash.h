// The integers behind every random number (docs/reference/sampling.md, "Numbers").
// Sources: M. Jarzynski, M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020 (pcg4d); B.
// Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020; S. Laine, T. Karras, "Stratified
// Sampling for Stochastic Transparency", 2011, with the constants of N. Vegdahl, "Building a Better
// LK Hash", 2021.
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

FACET_FUNCTION uint reversed_bits(uint x) {
  x = ((x & 0x55555555u) << 1u) | ((x >> 1u) & 0x55555555u);
  x = ((x & 0x33333333u) << 2u) | ((x >> 2u) & 0x33333333u);
  x = ((x & 0x0f0f0f0fu) << 4u) | ((x >> 4u) & 0x0f0f0f0fu);
  x = ((x & 0x00ff00ffu) << 8u) | ((x >> 8u) & 0x00ff00ffu);
  return (x << 16u) | (x >> 16u);
}

/// A bijection of 32 bits in which each bit depends on those below it and itself alone: Owen's
/// scrambling of a fraction whose bits are reversed.
FACET_FUNCTION uint laine_karras(uint x, uint seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16u) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// Bit j of the result is the sum modulo 2 of the bits k of x whose k has all of j's bits: the
/// second dimension of Sobol's sequence for index x, its bits reversed (that dimension's matrix is
/// Pascal's triangle modulo 2).
FACET_FUNCTION uint reversed_sobol_1(uint x) {
  x ^= (x & 0xaaaaaaaau) >> 1u;
  x ^= (x & 0xccccccccu) >> 2u;
  x ^= (x & 0xf0f0f0f0u) >> 4u;
  x ^= (x & 0xff00ff00u) >> 8u;
  return x ^ (x >> 16u);
}

/// Point `index` of Sobol's (0, 2)-sequence, shuffled and Owen-scrambled by three seeds.
FACET_FUNCTION uvec2 scrambled_sobol(uint index, uvec4 seeds) {
  uint shuffled = reversed_bits(laine_karras(reversed_bits(index), seeds.x));
  return uvec2(reversed_bits(laine_karras(shuffled, seeds.y)),
               reversed_bits(laine_karras(reversed_sobol_1(shuffled), seeds.z)));
}

/// The four words of a block of dimensions: components (0, 1) and (2, 3) are two pairs, shuffled
/// and scrambled apart.
FACET_FUNCTION uvec4 sobol_block(uint pixel, uint index, uint block, uint seed) {
  uvec2 first = scrambled_sobol(index, pcg4d(uvec4(pixel, block, 0u, seed)));
  uvec2 second = scrambled_sobol(index, pcg4d(uvec4(pixel, block, 1u, seed)));
  return uvec4(first, second);
}

/// The bits of x below 2^16, spread to the even places.
FACET_FUNCTION uint spread_bits(uint x) {
  x = (x | (x << 8u)) & 0x00ff00ffu;
  x = (x | (x << 4u)) & 0x0f0f0f0fu;
  x = (x | (x << 2u)) & 0x33333333u;
  return (x | (x << 1u)) & 0x55555555u;
}

/// Place of a pixel of a square along a curve that visits each quarter of it whole before the next,
/// each quarter's quarters likewise, and so on: Morton's, but that `turns` decides for each size of
/// squares which two quarters make a half: those beside one another, above one another, or across.
FACET_FUNCTION uint place_on_curve(uvec2 pixel, uint turns) {
  uint column = spread_bits(pixel.x);
  uint row = spread_bits(pixel.y);
  uint exchanged = turns & 0x55555555u;
  uint crossed = (turns >> 1u) & 0x55555555u & ~exchanged;
  uint half_of = (row & ~exchanged) | (column & exchanged);
  uint quarter_of = (column & ~exchanged) | (row & exchanged);
  half_of ^= quarter_of & crossed;
  return (half_of << 1u) | quarter_of;
}

/// Point of a pair of dimensions, by the place of a sample on a curve through the pixels of a tile
/// and 2^bits samples of each.
FACET_FUNCTION uvec2 zsobol_pair(uvec2 pixel_in_tile, uint sample_in_run, uint bits, uvec4 which) {
  uvec4 seeds = pcg4d(which);
  uint place = (place_on_curve(pixel_in_tile, seeds.w) << bits) | sample_in_run;
  return scrambled_sobol(place, seeds);
}

/// The four words of a block of dimensions, as sobol_block's, but that the points of neighbouring
/// pixels belong to one net as well, together with 2^bits samples of each pixel: errors of
/// neighbours cancel (A. G. M. Ahmed, P. Wonka, "Screen-Space Blue-Noise Diffusion of Monte Carlo
/// Sampling Error via Hierarchical Ordering of Pixels", ACM TOG 39(6), 2020). A net is that of a
/// tile as large as 32 bits can count, and of one run of 2^bits samples; others are independent.
FACET_FUNCTION uvec4 zsobol_block(uvec2 pixel, uint index, uint bits, uint block, uint seed) {
  uint side_bits = (32u - bits) / 2u;
  uvec4 net = pcg4d(uvec4(pixel >> side_bits, index >> bits, seed));
  uvec2 inside = pixel & ((1u << side_bits) - 1u);
  uint run = index & ((1u << bits) - 1u);
  uvec2 first = zsobol_pair(inside, run, bits, uvec4(net.x, block, 0u, net.y));
  uvec2 second = zsobol_pair(inside, run, bits, uvec4(net.x, block, 1u, net.y));
  return uvec4(first, second);
}

/// Words of candidate i of `count`, made of the first one's: i/count and the reversed bits of i
/// further, around the square. So all are spread over it.
FACET_FUNCTION uvec2 candidate_words(uvec2 first, uint i, uint count) {
  return first + uvec2(i * (0xffffffffu / count), reversed_bits(i));
}

FACET_SHARED_END
#endif
