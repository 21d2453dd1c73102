#include "scene/bsdf/diffuse.h"

#include "scene/xml/property_reader.h"

namespace facet::bsdf {

Diffuse Diffuse::read(PropertyReader& properties) { return {properties.reflectance("albedo", Color(0.5F))}; }

shared::BsdfRecord Diffuse::pack() const {
  shared::BsdfRecord r{};
  r.a = glm::vec4(albedo, 0);
  return r;
}

}  // namespace facet::bsdf
