#pragma once
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// A rough interface between two dielectrics; manual in shaders/bsdf/roughdielectric.glsl.
struct RoughDielectric {
  Textured<Color> ka{Color(1)};
  Textured<float> alpha{0.1F};
  float ext_ior = 1.000277F;
  float int_ior = 1.5046F;
  MicrofacetOptions options{};

  static RoughDielectric read(PropertyReader& properties);
  [[nodiscard]] shared::BsdfRecord pack() const;
};

}  // namespace facet::bsdf
