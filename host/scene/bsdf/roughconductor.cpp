#include "scene/bsdf/roughconductor.h"

#include "scene/xml/property_reader.h"

namespace facet::bsdf {

RoughConductor RoughConductor::read(PropertyReader& properties) {
  return {properties.reflectance("R0", Color(0.5F)), properties.roughness("alpha", 0.1F)};
}

shared::BsdfRecord RoughConductor::pack() const {
  shared::BsdfRecord r{};
  r.a = glm::vec4(r0, alpha);
  return r;
}

}  // namespace facet::bsdf
