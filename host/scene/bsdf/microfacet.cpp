#include "scene/bsdf/microfacet.h"

#include "scene/xml/property_reader.h"

namespace facet::bsdf {

Microfacet Microfacet::read(PropertyReader& properties) {
  Microfacet b;
  b.alpha = properties.roughness("alpha", b.alpha);
  b.ext_ior = properties.index_of_refraction("extIOR", b.ext_ior);
  b.int_ior = properties.index_of_refraction("intIOR", b.int_ior);
  b.kd = properties.reflectance("kd", b.kd);
  b.options = MicrofacetOptions::read(properties);
  return b;
}

shared::BsdfRecord Microfacet::pack() const {
  shared::BsdfRecord r = empty_record();
  r.flags = options.flags();
  r.a = glm::vec4(kd, alpha);
  r.b = glm::vec4(ext_ior, int_ior, 0, 0);
  return r;
}

}  // namespace facet::bsdf
