#pragma once
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// Rough metal; manual in shaders/bsdf/roughconductor.glsl.
struct RoughConductor {
  Textured<Color> r0{Color(0.5F)};
  Textured<float> alpha{0.1F};
  MicrofacetOptions options{};
  bool multiscatter = false;

  static RoughConductor read(PropertyReader& properties);
  [[nodiscard]] shared::BsdfRecord pack() const;
};

}  // namespace facet::bsdf
