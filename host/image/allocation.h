#pragma once
// How many samples each pixel of an adaptive render gets (docs/sampling.md, "Adaptive sampling").
#include <facet/film.h>

#include <functional>

namespace facet {

/// Fewest samples a pixel that a render can be adaptive with.
inline constexpr std::uint32_t least_adaptive_samples = 16;

/// Samples of every pixel whose variance decides about the others, of a render of `mean` samples a
/// pixel: a power of two. They are not part of the image.
[[nodiscard]] std::uint32_t pilot_samples(std::uint32_t mean);

/// Samples of each pixel, powers of two, from the smallest that any pixel gets to 64 times the
/// mean; together no more than are left when the pilot's are taken from `mean` for each.
/// first_half: the pilot's film after half of its samples, pilot: after all; both with squares.
[[nodiscard]] std::vector<std::uint32_t> allocate_samples(const Film& first_half, const Film& pilot,
                                                          std::uint32_t mean);

/// Samples that the pixels of an allocation have in common.
[[nodiscard]] std::uint32_t smallest_allocation(std::uint32_t mean);

/// What whoever renders does for an adaptive render.
struct AdaptiveSteps {
  /// Adds samples of these pixels of the film, which ascend, with the numbers of a seed; returns
  /// whether to go on.
  std::function<bool(const std::vector<std::uint32_t>& pixels, const SampleRange& samples,
                     std::uint32_t seed)>
      render;
  /// What has been added, with squares.
  std::function<Film()> film;
  /// Makes the film black again; so many samples are to come, over all pixels.
  std::function<void(std::uint64_t samples)> restart;
};

/// The pilot, whose film is thrown away, then twice as many samples from round to round, of ever
/// fewer pixels. mean: samples a pixel on average.
void render_adaptively(std::uint32_t mean, std::uint32_t seed, std::uint32_t pixel_count,
                       const AdaptiveSteps& steps);

}  // namespace facet
