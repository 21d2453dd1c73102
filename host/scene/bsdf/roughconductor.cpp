#include "scene/bsdf/roughconductor.h"

#include "scene/xml/property_reader.h"

namespace facet::bsdf {

void RoughConductor::check(const PropertyReader& properties) {
  const bool is_metal = !material.empty();
  if (!is_metal && !eta && !k) return;
  if (properties.has("R0") || r0.is_textured())
    properties.fail("R0", "excludes \"material\", \"eta\" and \"k\"");
  if (is_metal && (eta || k)) properties.fail("material", "excludes \"eta\" and \"k\"");
  if (is_metal) {
    const ConductorIor metal = find_metal(material).value();
    eta = metal.eta;
    k = metal.k;
  }
  if (!k) properties.fail("eta", "needs \"k\" beside it");
  if (!eta) properties.fail("k", "needs \"eta\" beside it");
}

}  // namespace facet::bsdf
