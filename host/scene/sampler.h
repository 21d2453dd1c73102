#pragma once
/* independent, sobol, zsobol: where the random numbers of a sample come from.

   `independent`: every number is a hash of pixel, sample and dimension (M. Jarzynski, M. Olano,
   JCGT 9(3), 2020).

   `sobol`: the samples of a pixel are spread evenly in each pair of dimensions that belong
   together: Owen-scrambled points of Sobol', shuffled from one pair to the next (B. Burley,
   "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020). Less noise, most of all where little
   but one light or one lobe is sampled; the numbers of samples that are powers of two serve best.
   The variance channels are too large with it: they take the samples of a pixel for independent.
   The estimated error (error_estimate, the channel `error`) does not: it rests on second estimates
   of some pixels, which take a sixtieth of the time for images of 256x256 pixels and more, up to a
   quarter for smaller ones and half for those of fewer than 512 pixels.

   `zsobol`: as sobol, and the points of neighbouring pixels complete one another, so that what is
   left of the noise is fine grain (A. G. M. Ahmed, P. Wonka, ACM TOG 39(6), 2020). The error of
   each pixel is the same on average, but the eye, and whatever blurs the image, sees less of it.
   Samples are put in order for the number of samples that is asked for, --spp or the scene's
   (rounded up to a power of two); fewer lack the order, and each further such run has one of its
   own. */
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "scene/plugin/parameter.h"
#include "shared/sampler_list.h"

namespace facet {

enum class Sampler : std::uint32_t {
#define FACET_SAMPLER(name, id) name = id,
  FACET_SAMPLER_LIST(FACET_SAMPLER)
#undef FACET_SAMPLER
};

/// What every sampler knows.
struct SamplerParameters {
  int sample_count = 1;
  std::uint32_t seed = 0;

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    visit("sampleCount", p.sample_count, parameter::Count{1, 1 << 30}, "samples a pixel");
    visit("seed", p.seed, parameter::Count{0, 0x7fffffff}, "another seed gives another estimate");
  }
};

/// The scene language's names, by id.
inline constexpr std::array sampler_names{
#define FACET_NAME(name, id) std::string_view(#name),
    FACET_SAMPLER_LIST(FACET_NAME)
#undef FACET_NAME
};

[[nodiscard]] constexpr std::string_view name_of(Sampler sampler) {
  return sampler_names.at(static_cast<std::size_t>(sampler));
}

/// Whether the samples of a pixel are independent of each other.
[[nodiscard]] constexpr bool is_independent(Sampler sampler) {
  return sampler == Sampler::independent;
}

[[nodiscard]] inline std::optional<Sampler> find_sampler(std::string_view name) {
  const auto* const found = std::find(sampler_names.begin(), sampler_names.end(), name);
  if (found == sampler_names.end()) return std::nullopt;
  return static_cast<Sampler>(found - sampler_names.begin());
}

}  // namespace facet
