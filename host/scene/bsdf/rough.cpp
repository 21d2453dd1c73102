#include "scene/bsdf/rough.h"

#include "scene/xml/property_reader.h"

namespace facet::bsdf {

MicrofacetOptions MicrofacetOptions::read(PropertyReader& properties) {
  const bool ggx = properties.choice("distribution", {"beckmann", "ggx"}) == "ggx";
  const bool exact = properties.choice("masking", {"rational", "exact"}) == "exact";
  return {ggx ? Distribution::ggx : Distribution::beckmann, exact ? Masking::exact : Masking::rational};
}

std::uint32_t MicrofacetOptions::flags() const {
  return (distribution == Distribution::ggx ? shared::BSDF_GGX : 0) |
         (masking == Masking::exact ? shared::BSDF_EXACT_MASKING : 0);
}

}  // namespace facet::bsdf
