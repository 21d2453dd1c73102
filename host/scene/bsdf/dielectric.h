#pragma once
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// A smooth interface between two dielectrics; manual in shaders/bsdf/dielectric.glsl.
struct Dielectric {
  float ext_ior = 1.000277F;
  float int_ior = 1.5046F;

  static Dielectric read(PropertyReader& properties);
  [[nodiscard]] shared::BsdfRecord pack() const;
};

}  // namespace facet::bsdf
