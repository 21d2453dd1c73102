#include "scene/bsdf/roughconductor.h"

#include "core/text.h"
#include "scene/xml/property_reader.h"

namespace facet::bsdf {

namespace {

ConductorIor metal_of(const PropertyReader& properties, const std::string& name) {
  const std::vector<std::string> names = metal_names();
  if (const auto metal = find_metal(name)) return *metal;
  properties.fail("material", fmt::format("is \"{}\", which is none of: {}{}", name,
                                          fmt::join(names, ", "), did_you_mean(name, names)));
}

/// By name, by number, or not at all.
std::optional<ConductorIor> read_ior(PropertyReader& properties, bool has_r0) {
  const std::string name = properties.string("material", "");
  const ConductorIor ior{properties.color_between("eta", 0.001F, 1000),
                         properties.color_between("k", 0, 1000)};
  const bool material = properties.has("material");
  const bool eta = properties.has("eta");
  const bool k = properties.has("k");
  if (!eta && !k && !material) return std::nullopt;
  if (has_r0) properties.fail("R0", "excludes \"material\", \"eta\" and \"k\"");
  if (material && (eta || k)) properties.fail("material", "excludes \"eta\" and \"k\"");
  if (material) return metal_of(properties, name);
  if (!k) properties.fail("eta", "needs \"k\" beside it");
  if (!eta) properties.fail("k", "needs \"eta\" beside it");
  return ior;
}

}  // namespace

RoughConductor RoughConductor::read(PropertyReader& properties) {
  RoughConductor b;
  b.r0 = properties.textured_reflectance("R0", b.r0.value);
  b.alpha = properties.textured_roughness("alpha", b.alpha.value);
  b.options = MicrofacetOptions::read(properties);
  b.multiscatter = properties.boolean("multiscatter", false);
  b.ior = read_ior(properties, properties.has("R0") || b.r0.is_textured());
  return b;
}

shared::BsdfRecord RoughConductor::pack() const {
  shared::BsdfRecord r = empty_record();
  r.flags = options.flags() | (multiscatter ? shared::BSDF_MULTISCATTER : 0);
  r.texture_a = r0.texture;
  r.texture_alpha = alpha.texture;
  r.a = glm::vec4(r0.value, alpha.value);
  if (ior) {
    r.flags |= shared::BSDF_CONDUCTOR;
    r.a = glm::vec4(ior->eta, alpha.value);
    r.b = glm::vec4(ior->k, 0);
  }
  return r;
}

}  // namespace facet::bsdf
