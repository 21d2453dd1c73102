#include "scene/bsdf/roughsubstrate.h"

#include "scene/xml/property_reader.h"

namespace facet::bsdf {

RoughSubstrate RoughSubstrate::read(PropertyReader& properties) {
  RoughSubstrate b;
  b.kd = properties.reflectance("kd", Color(0.5F));
  b.alpha = properties.roughness("alpha", 0.1F);
  b.ext_ior = properties.index_of_refraction("extIOR", 1.000277F);
  b.int_ior = properties.index_of_refraction("intIOR", 1.5046F);
  return b;
}

shared::BsdfRecord RoughSubstrate::pack() const {
  const double root = (static_cast<double>(ext_ior) - int_ior) / (static_cast<double>(ext_ior) + int_ior);
  shared::BsdfRecord r{};
  r.a = glm::vec4(kd, alpha);
  r.b = glm::vec4(ext_ior, int_ior, static_cast<float>(root * root), (kd.r + kd.g + kd.b) / 3.0F);
  return r;
}

}  // namespace facet::bsdf
