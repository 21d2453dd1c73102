#pragma once
// The reference's BSDFs by themselves, and a list of them for tests that hold for all.
#include "reference/bsdf/bsdf.h"
#include "reference/texture.h"

namespace facet::test {

/// The BSDF where no texture is, seen from above or below.
template <typename Real>
[[nodiscard]] reference::AnyBsdf<Real> make_bsdf(const Bsdf& bsdf, LobeSampling sampling,
                                                 bool below = false) {
  const std::vector<Texture> textures;
  const reference::Vec2<Real> uv(0);
  reference::Unwatched probe;
  const reference::Parameters<Real, reference::Unwatched> at(textures, uv, probe);
  reference::AnyBsdf<Real> made(bsdf, at, sampling);
  if (below) made.turn_over();
  return made;
}

/// Words of a sample by numbers in [0, 1).
[[nodiscard]] inline reference::BsdfNumbers numbers(double lobe, double u, double v) {
  const auto word = [](double x) { return static_cast<std::uint32_t>(std::ldexp(x, 32)); };
  return {word(lobe), word(u), word(v)};
}

struct NamedBsdf {
  std::string name;
  Bsdf bsdf;
};

inline constexpr bsdf::MicrofacetOptions rational_beckmann{};
inline constexpr bsdf::MicrofacetOptions exact_beckmann{bsdf::Distribution::beckmann,
                                                        Masking::exact};
inline constexpr bsdf::MicrofacetOptions ggx{bsdf::Distribution::ggx, Masking::rational};

/// Every BSDF that has values, of roughness alpha, under the options.
[[nodiscard]] inline std::vector<NamedBsdf> rough_bsdfs(float alpha,
                                                        const bsdf::MicrofacetOptions& options,
                                                        float ext_ior = 1, float int_ior = 1.5F) {
  const Color warm(0.9F, 0.5F, 0.1F);
  const Color cold(0.2F, 0.5F, 0.7F);
  return {{"roughconductor", bsdf::RoughConductor{warm, alpha, options}},
          {"roughsubstrate", bsdf::RoughSubstrate{cold, alpha, ext_ior, int_ior, options}},
          {"microfacet", bsdf::Microfacet{alpha, ext_ior, int_ior, cold, options}},
          {"fresnelblend", bsdf::FresnelBlend{cold, warm / 2.0F, alpha, options}},
          {"roughdielectric", bsdf::RoughDielectric{warm, alpha, ext_ior, int_ior, options}}};
}

/// Unit direction at an angle from the normal, radians; beyond a right angle it lies below.
[[nodiscard]] inline reference::Vec3<double> direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

}  // namespace facet::test
