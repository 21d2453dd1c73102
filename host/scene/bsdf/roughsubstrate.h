#pragma once
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// Diffuse base under a rough coat; manual in shaders/bsdf/roughsubstrate.glsl.
struct RoughSubstrate {
  Textured<Color> kd{Color(0.5F)};
  Textured<float> alpha{0.1F};
  float ext_ior = index_of_air;
  float int_ior = index_of_glass;
  MicrofacetOptions options{};

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    visit("kd", p.kd, Reflectance{}, "albedo of the base");
    visit("alpha", p.alpha, Roughness{}, "roughness of the coat");
    declare_indices(p, visit);
    MicrofacetOptions::declare(p.options, visit);
    visit.derived("f0", p.normal_reflectance());
  }
  /// The coat's reflectance at normal incidence.
  [[nodiscard]] float normal_reflectance() const {
    const double root =
        (static_cast<double>(ext_ior) - int_ior) / (static_cast<double>(ext_ior) + int_ior);
    return static_cast<float>(root * root);
  }
};

}  // namespace facet::bsdf
