#pragma once
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// A rough interface between two dielectrics; manual in shaders/bsdf/roughdielectric.glsl.
struct RoughDielectric {
  Textured<Color> ka{Color(1)};
  Textured<float> alpha{0.1F};
  float ext_ior = index_of_air;
  float int_ior = index_of_glass;
  MicrofacetOptions options{};

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    visit("ka", p.ka, Reflectance{.also_called = "m_ka"},
          "tint of both lobes; `m_ka` is another name for it");
    visit("alpha", p.alpha, Roughness{}, "roughness");
    declare_indices(p, visit);
    MicrofacetOptions::declare(p.options, visit);
  }
  /// Equal indices bend nothing, whatever the microfacet: light passes straight through.
  [[nodiscard]] std::uint32_t flags() const {
    return shared::BSDF_TRANSMITS | (ext_ior == int_ior ? shared::BSDF_DELTA : 0);
  }
};

}  // namespace facet::bsdf
