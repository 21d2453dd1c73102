#pragma once
#include "scene/bsdf/rough.h"

namespace facet::bsdf {

/// A smooth interface between two dielectrics; manual in shaders/bsdf/dielectric.glsl.
struct Dielectric {
  float ext_ior = index_of_air;
  float int_ior = index_of_glass;

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    declare_indices(p, visit);
  }
  [[nodiscard]] static std::uint32_t flags() { return shared::BSDF_DELTA | shared::BSDF_TRANSMITS; }
};

}  // namespace facet::bsdf
