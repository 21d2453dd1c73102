#pragma once
#include "core/maths.h"
#include "shared/records.h"

namespace facet {
class PropertyReader;
}

namespace facet::bsdf {

/// Lambertian reflection; manual in shaders/bsdf/diffuse.glsl.
struct Diffuse {
  Color albedo{0.5F};

  static Diffuse read(PropertyReader& properties);
  [[nodiscard]] shared::BsdfRecord pack() const;
};

}  // namespace facet::bsdf
