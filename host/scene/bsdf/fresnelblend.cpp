#include "scene/bsdf/fresnelblend.h"

#include "scene/xml/property_reader.h"

namespace facet::bsdf {

FresnelBlend FresnelBlend::read(PropertyReader& properties) {
  FresnelBlend b;
  b.rd = properties.textured_reflectance("Rd", b.rd.value);
  b.rs = properties.textured_reflectance("Rs", b.rs.value);
  b.alpha = properties.textured_roughness("alpha", b.alpha.value);
  b.options = MicrofacetOptions::read(properties);
  return b;
}

shared::BsdfRecord FresnelBlend::pack() const {
  shared::BsdfRecord r = empty_record();
  r.flags = options.flags();
  r.texture_a = rd.texture;
  r.texture_b = rs.texture;
  r.texture_alpha = alpha.texture;
  r.a = glm::vec4(rd.value, alpha.value);
  r.b = glm::vec4(rs.value, 0);
  return r;
}

}  // namespace facet::bsdf
