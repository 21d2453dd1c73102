#pragma once
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// Nori's rough plastic; manual in shaders/bsdf/microfacet.glsl.
struct Microfacet {
  float alpha = 0.1F;
  float ext_ior = 1.000277F;
  float int_ior = 1.5046F;
  Color kd{0.5F};
  MicrofacetOptions options{};

  static Microfacet read(PropertyReader& properties);
  [[nodiscard]] shared::BsdfRecord pack() const;
};

}  // namespace facet::bsdf
