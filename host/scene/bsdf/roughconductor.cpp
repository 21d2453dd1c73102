#include "scene/bsdf/roughconductor.h"

#include "scene/xml/property_reader.h"

namespace facet::bsdf {

RoughConductor RoughConductor::read(PropertyReader& properties) {
  RoughConductor b;
  b.r0 = properties.textured_reflectance("R0", b.r0.value);
  b.alpha = properties.textured_roughness("alpha", b.alpha.value);
  b.options = MicrofacetOptions::read(properties);
  b.multiscatter = properties.boolean("multiscatter", false);
  return b;
}

shared::BsdfRecord RoughConductor::pack() const {
  shared::BsdfRecord r = empty_record();
  r.flags = options.flags() | (multiscatter ? shared::BSDF_MULTISCATTER : 0);
  r.texture_a = r0.texture;
  r.texture_alpha = alpha.texture;
  r.a = glm::vec4(r0.value, alpha.value);
  return r;
}

}  // namespace facet::bsdf
