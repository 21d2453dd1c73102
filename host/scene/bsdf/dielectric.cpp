#include "scene/bsdf/dielectric.h"

#include "scene/xml/property_reader.h"

namespace facet::bsdf {

Dielectric Dielectric::read(PropertyReader& properties) {
  Dielectric b;
  b.ext_ior = properties.index_of_refraction("extIOR", b.ext_ior);
  b.int_ior = properties.index_of_refraction("intIOR", b.int_ior);
  return b;
}

shared::BsdfRecord Dielectric::pack() const {
  shared::BsdfRecord r = empty_record();
  r.flags = shared::BSDF_DELTA | shared::BSDF_TRANSMITS;
  r.b = glm::vec4(ext_ior, int_ior, 0, 0);
  return r;
}

}  // namespace facet::bsdf
