#pragma once
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// Diffuse base under a rough coat; manual in shaders/bsdf/roughsubstrate.glsl.
struct RoughSubstrate {
  Textured<Color> kd{Color(0.5F)};
  Textured<float> alpha{0.1F};
  float ext_ior = 1.000277F;
  float int_ior = 1.5046F;
  MicrofacetOptions options{};

  static RoughSubstrate read(PropertyReader& properties);
  [[nodiscard]] shared::BsdfRecord pack() const;
};

}  // namespace facet::bsdf
