#include "scene/bsdf/roughsubstrate.h"

#include "scene/xml/property_reader.h"

namespace facet::bsdf {

RoughSubstrate RoughSubstrate::read(PropertyReader& properties) {
  RoughSubstrate b;
  b.kd = properties.textured_reflectance("kd", b.kd.value);
  b.alpha = properties.textured_roughness("alpha", b.alpha.value);
  b.ext_ior = properties.index_of_refraction("extIOR", b.ext_ior);
  b.int_ior = properties.index_of_refraction("intIOR", b.int_ior);
  b.options = MicrofacetOptions::read(properties);
  return b;
}

shared::BsdfRecord RoughSubstrate::pack() const {
  shared::BsdfRecord r = empty_record();
  const double root =
      (static_cast<double>(ext_ior) - int_ior) / (static_cast<double>(ext_ior) + int_ior);
  r.flags = options.flags();
  r.texture_a = kd.texture;
  r.texture_alpha = alpha.texture;
  r.a = glm::vec4(kd.value, alpha.value);
  r.b = glm::vec4(ext_ior, int_ior, static_cast<float>(root * root), 0);
  return r;
}

}  // namespace facet::bsdf
