#pragma once
#include <optional>

#include "scene/bsdf/metals.h"
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// Rough metal; manual in shaders/bsdf/roughconductor.glsl.
struct RoughConductor {
  Textured<Color> r0{Color(0.5F)};
  Textured<float> alpha{0.1F};
  MicrofacetOptions options{};
  bool multiscatter = false;
  /// Instead of r0: the exact Fresnel term, not Schlick's.
  std::optional<ConductorIor> ior{};

  static RoughConductor read(PropertyReader& properties);
  [[nodiscard]] shared::BsdfRecord pack() const;
};

}  // namespace facet::bsdf
