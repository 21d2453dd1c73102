#pragma once
#include <optional>

#include "scene/bsdf/metals.h"
#include "scene/bsdf/rough.h"

namespace facet {
class PropertyReader;
}

namespace facet::bsdf {

/// Rough metal; manual in shaders/bsdf/roughconductor.glsl.
struct RoughConductor {
  Textured<Color> r0{Color(0.5F)};
  Textured<float> alpha{0.1F};
  MicrofacetOptions options{};
  bool multiscatter = false;
  std::string material{};      ///< a metal's name
  std::optional<Color> eta{};  ///< with k: given by numbers
  std::optional<Color> k{};

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    visit("alpha", p.alpha, Roughness{}, "roughness");
    visit("R0", p.r0, Reflectance{}, "reflectance at normal incidence, by Schlick's term");
    visit("material", p.material, WordOf{metal_names()},
          "a metal instead of R0, by the exact Fresnel term");
    visit("eta", p.eta, ColorBetween{0.001F, 1000},
          "its complex index of refraction eta + i k instead");
    visit("k", p.k, ColorBetween{0, 1000}, "to be given with eta");
    MicrofacetOptions::declare(p.options, visit);
    visit("multiscatter", p.multiscatter, Switch{shared::BSDF_MULTISCATTER},
          "give back the light that is lost between microfacets (Turquin 2019)");
    const ConductorIor index = p.ior().value_or(ConductorIor{});
    visit.derived("eta", index.eta);
    visit.derived("k", index.k);
  }

  /// Throws InputError where R0, material, eta and k exclude or lack each other.
  void check(const PropertyReader& properties) const;

  /// Of the metal, or by number: the exact Fresnel term instead of Schlick's. Nothing: R0.
  [[nodiscard]] std::optional<ConductorIor> ior() const {
    if (!material.empty()) return find_metal(material);
    if (!eta || !k) return std::nullopt;
    return ConductorIor{*eta, *k};
  }
  [[nodiscard]] std::uint32_t flags() const { return ior() ? shared::BSDF_CONDUCTOR : 0; }
};

}  // namespace facet::bsdf
