#pragma once
// What the rough BSDFs have in common.
#include <facet/request.h>

#include "core/maths.h"
#include "scene/texture/textured.h"
#include "shared/records.h"

namespace facet {
class PropertyReader;
}

namespace facet::bsdf {

/// Distribution of the microfacets' normals.
enum class Distribution { beckmann, ggx };

/* Properties of every rough BSDF:

   | parameter    | default  | meaning                                                         |
   |--------------|----------|-----------------------------------------------------------------|
   | distribution | beckmann | `beckmann` or `ggx`                                             |
   | masking      | rational | of Beckmann: `rational` (Walter et al. 2007, as in the lab) or `exact` |
*/
struct MicrofacetOptions {
  Distribution distribution = Distribution::beckmann;
  Masking masking = Masking::rational;

  static MicrofacetOptions read(PropertyReader& properties);
  /// Flags of the record.
  [[nodiscard]] std::uint32_t flags() const;
};

/// A record without textures.
[[nodiscard]] inline shared::BsdfRecord empty_record() {
  shared::BsdfRecord r{};
  r.texture_a = r.texture_b = r.texture_alpha = shared::NONE;
  return r;
}

}  // namespace facet::bsdf
