#pragma once
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// Lambertian reflection; manual in shaders/bsdf/diffuse.glsl.
struct Diffuse {
  Textured<Color> albedo{Color(0.5F)};

  static Diffuse read(PropertyReader& properties);
  [[nodiscard]] shared::BsdfRecord pack() const;
};

}  // namespace facet::bsdf
