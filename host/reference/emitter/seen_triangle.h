#pragma once
// A triangle as it is seen from a point (docs/reference/sampling.md, "By solid angle").
#include <algorithm>
#include <cmath>

#include "reference/real.h"

namespace facet::reference {

template <typename Real>
class SeenTriangle {
 public:
  /// Vertices, in world space. Without meaning from a vertex.
  SeenTriangle(const Vec3<Real>& v0, const Vec3<Real>& v1, const Vec3<Real>& v2,
               const Vec3<Real>& normal, const Vec3<Real>& from)
      : distances_(glm::length(v0 - from), glm::length(v1 - from), glm::length(v2 - from)),
        a_((v0 - from) / distances_.x),
        b_((v1 - from) / distances_.y),
        c_((v2 - from) / distances_.z),
        cosine_ab_(glm::dot(a_, b_)),
        cosine_bc_(glm::dot(b_, c_)),
        cosine_ca_(glm::dot(c_, a_)) {
    // Of the parallelepiped that the vertices span, by its height; that of the unit directions is
    // smaller by the product of the distances.
    const Vec3<Real> edge = v1 - v0;
    const Real length = glm::length(edge);
    const Real twice_area = length * glm::length(glm::cross(edge / length, v2 - v0));
    const Real height = std::abs(glm::dot(normal, v0 - from));
    volume_ = height * twice_area / (distances_.x * distances_.y * distances_.z);
    solid_angle_ = 2 * std::atan2(volume_, 1 + cosine_ab_ + cosine_bc_ + cosine_ca_);
  }

  /// sr; NaN where the point is a vertex.
  [[nodiscard]] Real solid_angle() const { return solid_angle_; }

  /// Barycentric weights of a point: u is the share of the solid angle between the edge ab and the
  /// arc from b through the point, v decides where on that arc it lies.
  [[nodiscard]] Vec3<Real> point(Real u, Real v) const {
    // The arc from b ends on the edge ac, at an angle from a: from tan(S/2) of the part, solved for
    // the tangent of half that angle.
    const Real part = u * solid_angle_ / 2;
    const Real sine = std::sin(part);
    const Vec3<Real> across = glm::cross(a_, c_);
    const Real sine_ca = glm::length(across);
    const Real opposite = (1 + cosine_ab_) * sine * sine_ca;
    // b . c - (a . b) (a . c), in products that keep their digits where the triangle looks small.
    const Real adjacent = volume_ * std::cos(part) - glm::dot(glm::cross(a_, b_), across) * sine;
    const Real angle = 2 * std::atan2(opposite, adjacent);
    const Real whole = std::atan2(sine_ca, cosine_ca_);
    const Real of_a = std::sin(std::max(whole - angle, Real(0))) / sine_ca;
    const Real of_c = std::sin(angle) / sine_ca;
    // Uniform in the cosine of the angle from b; `less` is what it is below 1.
    const Vec3<Real> apart = of_a * a_ + of_c * c_ - b_;
    const Real less_at_end = glm::dot(apart, apart) / 2;
    const Real less = v * less_at_end;
    const Real of_end = std::sqrt(v * (2 - less) / (2 - less_at_end));
    const Real of_b = std::max(1 - less - (1 - less_at_end) * of_end, Real(0));
    const Vec3<Real> weights = Vec3<Real>(of_end * of_a, of_b, of_end * of_c) / distances_;
    return weights / (weights.x + weights.y + weights.z);
  }

 private:
  Vec3<Real> distances_;
  Vec3<Real> a_;  ///< unit directions to the vertices
  Vec3<Real> b_;
  Vec3<Real> c_;
  Real cosine_ab_;
  Real cosine_bc_;
  Real cosine_ca_;
  Real volume_ = 0;  ///< |a . (b x c)|
  Real solid_angle_ = 0;
};

}  // namespace facet::reference
