#include "scene/bsdf/diffuse.h"

#include "scene/xml/property_reader.h"

namespace facet::bsdf {

Diffuse Diffuse::read(PropertyReader& properties) {
  return {properties.textured_reflectance("albedo", Color(0.5F))};
}

shared::BsdfRecord Diffuse::pack() const {
  shared::BsdfRecord r = empty_record();
  r.texture_a = albedo.texture;
  r.a = glm::vec4(albedo.value, 0);
  return r;
}

}  // namespace facet::bsdf
