#pragma once
// Textures at a point (docs/reference/sampling.md, "Textures").
#include "reference/grid.h"
#include "scene/scene.h"

namespace facet::reference {

/// Value at (u, v). item: the decisions' first number; they have two.
template <typename Real, typename Probe>
[[nodiscard]] Vec3<Real> texture_value(const CheckerTexture& t, const Vec2<Real>& uv,
                                       std::uint64_t item, Probe& probe) {
  const Real x = uv.x * static_cast<Real>(t.scale_x);
  const Real y = uv.y * static_cast<Real>(t.scale_y);
  const auto cell = [&](Real at, std::uint64_t axis) {
    return decided_floor(at, std::max(Real(1), std::abs(at)), DecisionKind::cell, item + axis,
                         probe);
  };
  const Real column = cell(x, 0);
  const Real row = cell(y, 1);
  // Each by itself: the sum of large numbers may round.
  const bool odd = (std::fmod(column, Real(2)) != 0) != (std::fmod(row, Real(2)) != 0);
  return Vec3<Real>(odd ? t.odd() : t.even());
}

template <typename Real, typename Probe>
[[nodiscard]] Vec3<Real> texture_value(const BitmapTexture& t, const Vec2<Real>& uv,
                                       std::uint64_t item, Probe& probe) {
  const auto width = static_cast<Real>(t.width);
  const auto height = static_cast<Real>(t.height);
  const Vec3<Real> scaled = probe.nudged(
      Vec3<Real>(uv.x * static_cast<Real>(t.scale_x), uv.y * static_cast<Real>(t.scale_y), 0));
  // Shares of the whole image, which carry rounding errors of 1.
  const Vec3<Real> shares = probe.nudged(
      Vec3<Real>(1 - (scaled.x - std::floor(scaled.x)), 1 - (scaled.y - std::floor(scaled.y)), 1));
  const Real x = shares.x * width;
  const Real y = shares.y * height;
  const Real left = decided_floor(x, width, DecisionKind::texel, item, probe);
  const Real upper = decided_floor(y, height, DecisionKind::texel, item + 1, probe);
  const auto texel = [&](Real column, Real row) {
    const std::size_t at =
        wrapped(static_cast<long long>(row), t.height) * static_cast<std::size_t>(t.width) +
        wrapped(static_cast<long long>(column), t.width);
    return Vec3<Real>(facet::texel(t, at));
  };
  const Real fx = x - left;
  const Real fy = y - upper;
  const Vec3<Real> above = texel(left, upper) * (1 - fx) + texel(left + 1, upper) * fx;
  const Vec3<Real> below = texel(left, upper + 1) * (1 - fx) + texel(left + 1, upper + 1) * fx;
  return (above * (1 - fy) + below * fy) * Vec3<Real>(t.factor);
}

/// Value of the scene's texture of that index at (u, v).
template <typename Real, typename Probe>
[[nodiscard]] Vec3<Real> texture_value(const std::vector<Texture>& textures, std::uint32_t index,
                                       const Vec2<Real>& uv, Probe& probe) {
  probe.uses(Part::texture, index);
  // Below 2 are the environment's decisions.
  const std::uint64_t item = 2 * (std::uint64_t{index} + 1);
  return probe.nudged(std::visit([&](const auto& t) { return texture_value(t, uv, item, probe); },
                                 textures[index]));
}

/// Values of a BSDF's parameters at a point.
template <typename Real, typename Probe>
class Parameters {
 public:
  Parameters(const std::vector<Texture>& textures, const Vec2<Real>& uv, Probe& probe)
      : textures_(textures), uv_(uv), probe_(probe) {}

  [[nodiscard]] Vec3<Real> color(const Textured<Color>& p) const {
    return p.is_textured() ? texture_value(textures_, p.texture, uv_, probe_) : Vec3<Real>(p.value);
  }
  [[nodiscard]] Real roughness(const Textured<float>& p) const {
    if (!p.is_textured()) return p.value;
    const Vec3<Real> c = texture_value(textures_, p.texture, uv_, probe_);
    const Real value = Real(0.2126) * c.r + Real(0.7152) * c.g + Real(0.0722) * c.b;
    return std::clamp(value, Real(1e-4), Real(1));
  }

 private:
  const std::vector<Texture>& textures_;
  const Vec2<Real>& uv_;
  Probe& probe_;
};

}  // namespace facet::reference
