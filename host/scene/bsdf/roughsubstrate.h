#pragma once
#include "core/maths.h"
#include "shared/records.h"

namespace facet {
class PropertyReader;
}

namespace facet::bsdf {

/// Diffuse base under a rough coat; manual in shaders/bsdf/roughsubstrate.glsl.
struct RoughSubstrate {
  Color kd{0.5F};
  float alpha = 0.1F;
  float ext_ior = 1.000277F;
  float int_ior = 1.5046F;

  static RoughSubstrate read(PropertyReader& properties);
  [[nodiscard]] shared::BsdfRecord pack() const;
};

}  // namespace facet::bsdf
