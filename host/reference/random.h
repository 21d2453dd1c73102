#pragma once
// The numbers behind a sample's decisions (docs/reference/sampling.md, "Numbers").
#include <cstdint>

#include "scene/sampler.h"
#include "shared/dimensions.h"
#include "shared/random_hash.h"

namespace facet::reference {

/// Which sample of which pixel.
struct SampleId {
  std::uint32_t pixel = 0;  ///< y * width + x of the whole image
  std::uint32_t index = 0;
  std::uint32_t seed = 0;
  Sampler sampler = Sampler::independent;
  shared::uvec2 position{0};     ///< x, y of the pixel in the whole image
  std::uint32_t order_bits = 0;  ///< zsobol: 2^order_bits samples of a pixel belong to one net
};

/// A word as a number in [0, 1 - 2^-24].
template <typename Real>
[[nodiscard]] Real number_of(std::uint32_t word) {
  return static_cast<Real>(word >> 8U) / Real(16777216);
}

/// Four words, one for each component of a block of dimensions.
struct Block {
  shared::uvec4 words;

  [[nodiscard]] std::uint32_t word(std::uint32_t component) const {
    return words[static_cast<int>(component)];
  }
  /// A component as a number in [0, 1 - 2^-24].
  template <typename Real>
  [[nodiscard]] Real number(std::uint32_t component) const {
    return number_of<Real>(word(component));
  }

  /// That of candidate i of `count` emitter samples, of which this is the first.
  [[nodiscard]] Block candidate(std::uint32_t i, std::uint32_t count) const {
    Block block = *this;
    const shared::uvec2 pair =
        shared::candidate_words({word(shared::EMITTER_U), word(shared::EMITTER_V)}, i, count);
    block.words[static_cast<int>(shared::EMITTER_U)] = pair.x;
    block.words[static_cast<int>(shared::EMITTER_V)] = pair.y;
    return block;
  }
};

[[nodiscard]] inline Block block_of(const SampleId& id, std::uint32_t block) {
  if (id.sampler == Sampler::sobol)
    return {shared::sobol_block(id.pixel, id.index, block, id.seed)};
  if (id.sampler == Sampler::zsobol)
    return {shared::zsobol_block(id.position, id.index, id.order_bits, block, id.seed)};
  return {shared::pcg4d({id.pixel, id.index, block, id.seed})};
}

[[nodiscard]] inline Block camera_block(const SampleId& id) {
  return block_of(id, shared::BLOCK_CAMERA);
}

/// Block BOUNCE_EMITTER or BOUNCE_BSDF of interaction k = 1, 2, ...
[[nodiscard]] inline Block bounce_block(const SampleId& id, std::uint32_t k, std::uint32_t which) {
  return block_of(id, shared::BLOCK_FIRST_BOUNCE + (k - 1) * shared::BLOCKS_PER_BOUNCE + which);
}

/// Block of a sample of emitter e = 0, 1, ... of `count` at interaction k = 1, 2, ..., where every
/// emitter is sampled.
[[nodiscard]] inline Block emitter_block(const SampleId& id, std::uint32_t k, std::size_t e,
                                         std::size_t count) {
  const std::size_t block = shared::BLOCK_EVERY_EMITTER + (k - 1) * count + e;
  return block_of(id, static_cast<std::uint32_t>(block));
}

}  // namespace facet::reference
