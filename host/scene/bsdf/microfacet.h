#pragma once
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// Nori's rough plastic; manual in shaders/bsdf/microfacet.glsl.
struct Microfacet {
  float alpha = 0.1F;
  float ext_ior = index_of_air;
  float int_ior = index_of_glass;
  Color kd{0.5F};
  MicrofacetOptions options{};

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    visit("kd", p.kd, Reflectance{}, "albedo of the base; the coat has 1 - max(kd)");
    visit("alpha", p.alpha, Roughness{}, "roughness of the coat");
    declare_indices(p, visit);
    MicrofacetOptions::declare(p.options, visit);
  }
};

}  // namespace facet::bsdf
