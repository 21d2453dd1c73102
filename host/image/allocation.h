#pragma once
// How many samples each pixel of an adaptive render gets (docs/sampling.md, "Adaptive sampling").
#include <facet/film.h>

namespace facet {

/// Fewest samples a pixel that a render can be adaptive with.
inline constexpr std::uint32_t least_adaptive_samples = 16;

/// Samples of every pixel whose variance decides about the others, of a render of `mean` samples a
/// pixel: a power of two. They are not part of the image.
[[nodiscard]] std::uint32_t pilot_samples(std::uint32_t mean);

/// Seed of these samples: another than that of the image's.
[[nodiscard]] std::uint32_t pilot_seed(std::uint32_t seed);

/// Samples of each pixel, powers of two, from the smallest that any pixel gets to 64 times the
/// mean; together no more than are left when the pilot's are taken from `mean` for each.
/// first_half: the pilot's film after half of its samples, pilot: after all; both with squares.
[[nodiscard]] std::vector<std::uint32_t> allocate_samples(const Film& first_half, const Film& pilot,
                                                          std::uint32_t mean);

/// Samples that the pixels of an allocation have in common.
[[nodiscard]] std::uint32_t smallest_allocation(std::uint32_t mean);

}  // namespace facet
