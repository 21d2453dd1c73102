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
  std::string material{};      ///< the metal's name that eta and k come from; may be empty
  std::optional<Color> eta{};  ///< with k: the complex index of refraction, instead of r0
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
    visit.derived("eta", p.eta.value_or(Color(0)));
    visit.derived("k", p.k.value_or(Color(0)));
  }

  /// Throws InputError where R0, material, eta and k exclude or lack each other. A material's eta
  /// and k become the object's: they are averages over a spectrum, to be taken once.
  void check(const PropertyReader& properties);

  /// The exact Fresnel term's, instead of Schlick's. Nothing: R0.
  [[nodiscard]] std::optional<ConductorIor> ior() const {
    if (!eta || !k) return std::nullopt;
    return ConductorIor{*eta, *k};
  }
  [[nodiscard]] std::uint32_t flags() const { return ior() ? shared::BSDF_CONDUCTOR : 0; }
};

}  // namespace facet::bsdf
