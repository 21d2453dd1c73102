#pragma once
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// A perfect mirror; manual in shaders/bsdf/mirror.glsl.
struct Mirror {
  static Mirror read(PropertyReader& properties);
  [[nodiscard]] shared::BsdfRecord pack() const;
};

}  // namespace facet::bsdf
