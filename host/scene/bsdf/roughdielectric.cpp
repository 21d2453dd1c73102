#include "scene/bsdf/roughdielectric.h"

#include "scene/xml/property_reader.h"

namespace facet::bsdf {

RoughDielectric RoughDielectric::read(PropertyReader& properties) {
  RoughDielectric b;
  b.ka = properties.textured_reflectance("ka", b.ka.value, "m_ka");
  b.alpha = properties.textured_roughness("alpha", b.alpha.value);
  b.ext_ior = properties.index_of_refraction("extIOR", b.ext_ior);
  b.int_ior = properties.index_of_refraction("intIOR", b.int_ior);
  b.options = MicrofacetOptions::read(properties);
  return b;
}

shared::BsdfRecord RoughDielectric::pack() const {
  shared::BsdfRecord r = empty_record();
  // Equal indices bend nothing, whatever the microfacet: light passes straight through.
  r.flags =
      options.flags() | shared::BSDF_TRANSMITS | (ext_ior == int_ior ? shared::BSDF_DELTA : 0);
  r.texture_a = ka.texture;
  r.texture_alpha = alpha.texture;
  r.a = glm::vec4(ka.value, alpha.value);
  r.b = glm::vec4(ext_ior, int_ior, 0, 0);
  return r;
}

}  // namespace facet::bsdf
