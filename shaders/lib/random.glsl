// Random numbers as a function of pixel, sample and dimension (docs/reference/sampling.md,
// "Numbers").
#ifndef FACET_RANDOM_GLSL
#define FACET_RANDOM_GLSL
#include "../shared/dimensions.h"
#include "../shared/random_hash.h"
#include "specialization.glsl"

/// What a random number depends on beside its dimension.
struct SampleId {
  uint pixel;  // y * width + x of the whole image
  uint index;  // of the sample
  uint seed;
  uvec2 position;   // x, y of the pixel in the whole image
  uint order_bits;  // zsobol: 2^order_bits samples of a pixel belong to one net
};

/// The four words of a block.
uvec4 random_block(SampleId id, uint block) {
  if (SAMPLER == SAMPLER_sobol) return sobol_block(id.pixel, id.index, block, id.seed);
  if (SAMPLER == SAMPLER_zsobol)
    return zsobol_block(id.position, id.index, id.order_bits, block, id.seed);
  return pcg4d(uvec4(id.pixel, id.index, block, id.seed));
}

/// A word as a number in [0, 1 - 2^-24].
float unit_float(uint bits) { return float(bits >> 8u) * 5.96046448e-8; }

/// First of a bounce's blocks, bounce = 1, 2, ...
uint bounce_block(uint bounce) { return BLOCK_FIRST_BOUNCE + (bounce - 1u) * BLOCKS_PER_BOUNCE; }

#endif
