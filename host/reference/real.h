#pragma once
// The reference's numbers: everything here is a template over float and double.
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>

namespace facet::reference {

template <typename Real>
using Vec2 = glm::vec<2, Real>;
template <typename Real>
using Vec3 = glm::vec<3, Real>;

template <typename Real>
inline constexpr Real pi = std::numbers::pi_v<Real>;

/// "No limit" for distances along a ray.
template <typename Real>
inline constexpr Real unlimited = static_cast<Real>(3e38);

template <typename Real>
[[nodiscard]] Real largest_component(const Vec3<Real>& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Unit vector along v whatever its length; 0 for the zero vector. The scale is a power of two, so
/// that it costs no digits.
template <typename Real>
[[nodiscard]] Vec3<Real> unit(const Vec3<Real>& v) {
  const Real largest = largest_component(v);
  if (!(largest > 0)) return Vec3<Real>(0);
  const Vec3<Real> s = v * std::ldexp(Real(1), -std::ilogb(largest));
  return s / std::sqrt(glm::dot(s, s));
}

/// Distance from |x| to the next larger number.
template <typename Real>
[[nodiscard]] Real ulp(Real x) {
  const Real a = std::abs(x);
  return std::nextafter(a, std::numeric_limits<Real>::infinity()) - a;
}

/// Orthonormal shading frame of Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1),
/// 2017.
template <typename Real>
struct Frame {
  Vec3<Real> s;
  Vec3<Real> t;
  Vec3<Real> n;

  /// below: whether n counts as pointing to negative z (docs/reference/sampling.md: n.z < 0).
  Frame(const Vec3<Real>& normal, bool below) : n(normal) {
    const Real sigma = below ? Real(-1) : Real(1);
    const Real a = Real(-1) / (sigma + n.z);
    const Real b = n.x * n.y * a;
    s = {1 + sigma * n.x * n.x * a, sigma * b, -sigma * n.x};
    t = {b, sigma + n.y * n.y * a, -n.y};
  }

  [[nodiscard]] Vec3<Real> to_local(const Vec3<Real>& w) const {
    return {glm::dot(w, s), glm::dot(w, t), glm::dot(w, n)};
  }
  [[nodiscard]] Vec3<Real> to_world(const Vec3<Real>& w) const {
    return w.x * s + w.y * t + w.z * n;
  }
};

/// Sine and cosine of 2 pi v, exact at multiples of a quarter turn.
template <typename Real>
void sin_cos_turns(Real v, Real& sine, Real& cosine) {
  const Real quarter = std::nearbyint(4 * v);
  const Real angle = 2 * pi<Real> * (v - quarter / 4);
  const Real s = std::sin(angle);
  const Real c = std::cos(angle);
  switch (static_cast<int>(quarter) & 3) {
    case 0:
      sine = s, cosine = c;
      break;
    case 1:
      sine = c, cosine = -s;
      break;
    case 2:
      sine = -s, cosine = -c;
      break;
    default:
      sine = -c, cosine = s;
      break;
  }
}

}  // namespace facet::reference
