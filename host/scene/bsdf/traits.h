#pragma once
// What any BSDF's parameters say of its roughness and of the media on its sides.
#include "scene/bsdf/bsdf.h"

namespace facet {

namespace detail {
[[nodiscard]] inline float constant_of(float value) { return value; }
[[nodiscard]] inline float constant_of(const Textured<float>& value) { return value.value; }
}  // namespace detail

/// Roughness, without regard to textures; 1 where there is none.
[[nodiscard]] inline float roughness_of(const Bsdf& bsdf) {
  return std::visit(
      [](const auto& p) {
        if constexpr (requires { p.alpha; }) {
          return detail::constant_of(p.alpha);
        } else {
          return 1.0F;
        }
      },
      bsdf);
}

/// Index of refraction above the surface or below it; 1 without indices.
[[nodiscard]] inline double index_of_side(const Bsdf& bsdf, bool below) {
  return std::visit(
      [&](const auto& p) {
        if constexpr (requires { p.ext_ior; }) {
          return static_cast<double>(below ? p.int_ior : p.ext_ior);
        } else {
          return 1.0;
        }
      },
      bsdf);
}

}  // namespace facet
