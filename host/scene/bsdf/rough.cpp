#include "scene/bsdf/rough.h"

#include "core/words.h"
#include "scene/xml/property_reader.h"

namespace facet::bsdf {

MicrofacetOptions MicrofacetOptions::read(PropertyReader& properties) {
  const bool ggx = properties.choice("distribution", {"beckmann", "ggx"}) == "ggx";
  const auto masking =
      value_of(masking_words, properties.choice("masking", names_of(masking_words)));
  return {ggx ? Distribution::ggx : Distribution::beckmann, masking.value()};
}

std::uint32_t MicrofacetOptions::flags() const {
  return (distribution == Distribution::ggx ? shared::BSDF_GGX : 0) |
         (masking == Masking::exact ? shared::BSDF_EXACT_MASKING : 0);
}

}  // namespace facet::bsdf
