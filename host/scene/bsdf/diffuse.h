#pragma once
#include "scene/plugin/parameter.h"

namespace facet::bsdf {

/// Lambertian reflection; manual in shaders/bsdf/diffuse.glsl.
struct Diffuse {
  Textured<Color> albedo{Color(0.5F)};

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    visit("albedo", p.albedo, parameter::Reflectance{}, "share of light that is reflected");
  }
};

}  // namespace facet::bsdf
