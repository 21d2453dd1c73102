#pragma once
// What the rough BSDFs have in common.
#include <facet/request.h>

#include "scene/plugin/parameter.h"
#include "shared/records.h"

namespace facet::bsdf {

/// Distribution of the microfacets' normals.
enum class Distribution { beckmann, ggx };

inline constexpr std::array distribution_words{Word{Distribution::beckmann, "beckmann"},
                                               Word{Distribution::ggx, "ggx"}};

/// Parameters of every rough BSDF.
struct MicrofacetOptions {
  Distribution distribution = Distribution::beckmann;
  Masking masking = Masking::rational;

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    visit("distribution", p.distribution, Choice{distribution_words, shared::BSDF_GGX},
          "of the microfacets' normals");
    visit("masking", p.masking, Choice{masking_words, shared::BSDF_EXACT_MASKING},
          "of Beckmann: Walter et al. 2007, within 0.35 %, or exact");
  }
};

/// Indices of refraction of air and of a common glass (BK7).
inline constexpr float index_of_air = 1.000277F;
inline constexpr float index_of_glass = 1.5046F;

/// Declares both sides' indices of an interface.
template <typename Self, typename Visitor>
void declare_indices(Self& p, Visitor& visit) {
  using parameter::RefractiveIndex;
  visit("intIOR", p.int_ior, RefractiveIndex{}, "index of refraction below the surface");
  visit("extIOR", p.ext_ior, RefractiveIndex{}, "index above");
}

}  // namespace facet::bsdf
