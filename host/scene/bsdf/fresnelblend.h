#pragma once
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// PBRT's FresnelBlend: a diffuse base that a glossy coat dims; manual in
/// shaders/bsdf/fresnelblend.glsl.
struct FresnelBlend {
  Textured<Color> rd{Color(0.5F)};
  Textured<Color> rs{Color(0.5F)};
  Textured<float> alpha{0.1F};
  MicrofacetOptions options{};

  static FresnelBlend read(PropertyReader& properties);
  [[nodiscard]] shared::BsdfRecord pack() const;
};

}  // namespace facet::bsdf
