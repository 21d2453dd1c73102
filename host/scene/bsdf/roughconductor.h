#pragma once
#include "core/maths.h"
#include "shared/records.h"

namespace facet {
class PropertyReader;
}

namespace facet::bsdf {

/// Rough metal; manual in shaders/bsdf/roughconductor.glsl.
struct RoughConductor {
  Color r0{0.5F};
  float alpha = 0.1F;

  static RoughConductor read(PropertyReader& properties);
  [[nodiscard]] shared::BsdfRecord pack() const;
};

}  // namespace facet::bsdf
