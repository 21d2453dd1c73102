#pragma once
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// PBRT's FresnelBlend: a diffuse base that a glossy coat dims; manual in
/// shaders/bsdf/fresnelblend.glsl.
struct FresnelBlend {
  Textured<Color> rd{Color(0.5F)};
  Textured<Color> rs{Color(0.5F)};
  Textured<float> alpha{0.1F};
  MicrofacetOptions options{};

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    visit("Rd", p.rd, Reflectance{}, "reflectance of the base");
    visit("Rs", p.rs, Reflectance{}, "reflectance of the coat at normal incidence");
    visit("alpha", p.alpha, Roughness{}, "roughness of the coat");
    MicrofacetOptions::declare(p.options, visit);
  }
};

}  // namespace facet::bsdf
