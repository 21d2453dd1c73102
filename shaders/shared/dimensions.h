// The random dimension of every decision (docs/reference/sampling.md, "Dimensions"). A block of
// four dimensions is one call of the hash; dimension d is component d % 4 of block d / 4.
#ifndef FACET_SHARED_DIMENSIONS_H
#define FACET_SHARED_DIMENSIONS_H
#include "types.h"
FACET_SHARED_BEGIN

FACET_CONSTANT uint DIMENSIONS_PER_BLOCK = 4u;

/// Block of the camera: the filter's x and y offset; two are free.
FACET_CONSTANT uint BLOCK_CAMERA = 0u;
FACET_CONSTANT uint CAMERA_FILTER_X = 0u;
FACET_CONSTANT uint CAMERA_FILTER_Y = 1u;

/// Surface interaction k = 1, 2, ... owns the blocks BLOCK_FIRST_BOUNCE + (k - 1) *
/// BLOCKS_PER_BOUNCE + ...
FACET_CONSTANT uint BLOCK_FIRST_BOUNCE = 1u;
FACET_CONSTANT uint BLOCKS_PER_BOUNCE = 2u;

/// Where every emitter is sampled, emitter e of E owns block BLOCK_EVERY_EMITTER + (k - 1) E + e of
/// interaction k.
FACET_CONSTANT uint BLOCK_EVERY_EMITTER = 0x80000000u;

/// Component 0 of block BLOCK_CANDIDATES + k - 1 chooses the candidate of interaction k's emitter
/// sample.
FACET_CONSTANT uint BLOCK_CANDIDATES = 0xc0000000u;

/// First block of a bounce: the emitter sample. The fills stand behind what choices leave of u and
/// v.
FACET_CONSTANT uint BOUNCE_EMITTER = 0u;
FACET_CONSTANT uint EMITTER_FIRST_FILL = 0u;
FACET_CONSTANT uint EMITTER_SECOND_FILL = 1u;
FACET_CONSTANT uint EMITTER_U = 2u;
FACET_CONSTANT uint EMITTER_V = 3u;

/// Second block of a bounce: the BSDF sample and Russian roulette. u and v are one pair of the
/// sobol sampler; the lobe's word also stands behind what a choice leaves of u.
FACET_CONSTANT uint BOUNCE_BSDF = 1u;
FACET_CONSTANT uint BSDF_LOBE = 0u;
FACET_CONSTANT uint BSDF_ROULETTE = 1u;
FACET_CONSTANT uint BSDF_U = 2u;
FACET_CONSTANT uint BSDF_V = 3u;

FACET_SHARED_END
#endif
