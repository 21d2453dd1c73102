#pragma once
// Rays against triangles and tree. The test is S. Woop, C. Benthin, I. Wald, "Watertight
// Ray/Triangle Intersection", JCGT 2(1), 2013: permuted axes, a shear, and an edge function again
// in double where it is 0; t is that of the plane (docs/reference/sampling.md, "Intersection").
#include <algorithm>

#include "reference/geometry.h"

namespace facet::reference {

/// A ray's share of the triangle test: the largest axis of the direction becomes z, the others are
/// sheared.
template <typename Real>
struct Shear {
  int kx;
  int ky;
  int kz;
  Real x;
  Real y;

  explicit Shear(const Vec3<Real>& d) {
    const Vec3<Real> a = glm::abs(d);
    kz = a.x > a.y ? (a.x > a.z ? 0 : 2) : (a.y > a.z ? 1 : 2);
    kx = (kz + 1) % 3;
    ky = (kx + 1) % 3;
    x = d[kx] / d[kz];
    y = d[ky] / d[kz];
  }

  [[gnu::always_inline, nodiscard]] Vec2<Real> apply(const Vec3<Real>& v) const {
    return {v[kx] - x * v[kz], v[ky] - y * v[kz]};
  }
};

/// Where the ray's line meets the triangle's plane: t and barycentric weights; valid false for a
/// plane seen edge on.
template <typename Real>
struct PlaneHit {
  bool valid = false;
  Real t = 0;
  std::array<Real, 3> b{};
  bool inside = false;

  [[nodiscard]] Real smallest_weight() const { return std::min({b[0], b[1], b[2]}); }
};

template <typename Real>
[[nodiscard]] Real edge_function(Real px, Real py, Real qx, Real qy) {
  const Real e = px * qy - py * qx;
  if (e != 0 || sizeof(Real) == sizeof(double)) return e;
  return static_cast<Real>(static_cast<double>(px) * static_cast<double>(qy) -
                           static_cast<double>(py) * static_cast<double>(qx));
}

template <typename Real>
[[nodiscard]] PlaneHit<Real> meet_plane(const Shear<Real>& shear, const Ray<Real>& ray,
                                        const Triangle<Real>& triangle) {
  const Vec2<Real> a = shear.apply(triangle.vertices[0] - ray.origin);
  const Vec2<Real> b = shear.apply(triangle.vertices[1] - ray.origin);
  const Vec2<Real> c = shear.apply(triangle.vertices[2] - ray.origin);
  const Real u = edge_function(c.x, c.y, b.x, b.y);
  const Real v = edge_function(a.x, a.y, c.x, c.y);
  const Real w = edge_function(b.x, b.y, a.x, a.y);
  const Real determinant = u + v + w;
  PlaneHit<Real> hit;
  const Real speed = glm::dot(triangle.normal, ray.direction);
  if (determinant == 0 || speed == 0) return hit;
  hit.valid = true;
  hit.inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  hit.b = {u / determinant, v / determinant, w / determinant};
  hit.t = glm::dot(triangle.normal, triangle.vertices[0] - ray.origin) / speed;
  return hit;
}

/// The ray against boxes; inlined whatever else is in the unit, since traversal is little else.
/// grown: boxes count as larger by this share of their size. Rounding needs 16 ulps of the
/// distances besides.
template <typename Real>
class BoxTest {
 public:
  BoxTest(const Ray<Real>& ray, Real grown) : origin_(ray.origin), grown_(grown) {
    for (int i = 0; i < 3; ++i) {
      const Real d = ray.direction[i];
      // Finite: 0 times it is 0 where a plane goes through the origin.
      constexpr Real smallest = static_cast<Real>(1e-30);
      inverse_[i] = 1 / (std::abs(d) >= smallest ? d : std::copysign(smallest, d));
    }
  }

  /// Whether the ray is in the box somewhere in [t_min, t_max]; near: where it enters.
  [[gnu::always_inline, nodiscard]] bool meets(const Box& box, Real t_min, Real t_max,
                                               Real& near) const {
    near = t_min;
    Real far = t_max;
    for (int i = 0; i < 3; ++i) {
      const Real growth = grown_ * (Real(box.upper[i]) - Real(box.lower[i]));
      const Real a = (Real(box.lower[i]) - growth - origin_[i]) * inverse_[i];
      const Real b = (Real(box.upper[i]) + growth - origin_[i]) * inverse_[i];
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return near <= far + std::abs(far) * (16 * std::numeric_limits<Real>::epsilon());
  }

 private:
  Vec3<Real> origin_;
  Vec3<Real> inverse_;
  Real grown_;
};

/// Calls visit(first, count, t_max) for each leaf that the ray may meet before t_max, nearer
/// children first; visit may lower t_max, and ends the traversal by returning true.
template <typename Real, typename Visit>
void traverse(const Tree& tree, const Ray<Real>& ray, Real grown, const Visit& visit) {
  if (tree.nodes.empty()) return;
  const BoxTest<Real> test(ray, grown);
  struct Entry {
    std::uint32_t node;
    Real near;
  };
  std::array<Entry, tree_depth_limit>
      stack;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled as used
  std::size_t size = 0;
  Real t_max = ray.t_max;
  Real near = 0;
  if (!test.meets(tree.nodes[0].box, ray.t_min, t_max, near)) return;
  stack[size++] = {0, near};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.near > t_max * (1 + 16 * std::numeric_limits<Real>::epsilon())) continue;
    std::uint32_t index = entry.node;
    while (tree.nodes[index].count == 0) {
      const std::uint32_t left = index + 1;
      const std::uint32_t right = tree.nodes[index].first_or_right;
      Real near_left = 0;
      Real near_right = 0;
      const bool meets_left = test.meets(tree.nodes[left].box, ray.t_min, t_max, near_left);
      const bool meets_right = test.meets(tree.nodes[right].box, ray.t_min, t_max, near_right);
      if (!meets_left && !meets_right) break;
      const bool left_first = meets_left && (!meets_right || near_left <= near_right);
      if (meets_left && meets_right) {
        stack[size++] = left_first ? Entry{right, near_right} : Entry{left, near_left};
      }
      index = left_first ? left : right;
    }
    const TreeNode& leaf = tree.nodes[index];
    if (leaf.count > 0 && visit(leaf.first_or_right, leaf.count, t_max)) return;
  }
}

/// Nearest hit with t_min < t < t_max.
template <typename Real>
[[nodiscard]] Hit<Real> closest_hit(const Geometry<Real>& geometry, const Ray<Real>& ray) {
  const Shear<Real> shear(ray.direction);
  Hit<Real> hit;
  hit.t = ray.t_max;
  traverse(geometry.tree, ray, Real(0), [&](std::uint32_t first, std::uint32_t count, Real& t_max) {
    for (std::uint32_t i = first; i < first + count; ++i) {
      const PlaneHit<Real> plane = meet_plane(shear, ray, geometry.triangles[i]);
      if (!plane.inside || !plane.valid || !(plane.t > ray.t_min && plane.t < ray.t_max)) continue;
      // Of equal distances the triangle of the lower number counts, whatever is visited first.
      if (plane.t > hit.t || (plane.t == hit.t && i > hit.triangle)) continue;
      hit = {plane.t, i, plane.b[1], plane.b[2]};
      t_max = plane.t;
    }
    return false;
  });
  return hit;
}

/// Whether anything is hit with t_min < t < t_max.
template <typename Real>
[[nodiscard]] bool any_hit(const Geometry<Real>& geometry, const Ray<Real>& ray) {
  const Shear<Real> shear(ray.direction);
  bool found = false;
  traverse(geometry.tree, ray, Real(0),
           [&](std::uint32_t first, std::uint32_t count, Real& /*t_max*/) {
             for (std::uint32_t i = first; i < first + count && !found; ++i) {
               const PlaneHit<Real> plane = meet_plane(shear, ray, geometry.triangles[i]);
               found = plane.valid && plane.inside && plane.t > ray.t_min && plane.t < ray.t_max;
             }
             return found;
           });
  return found;
}

}  // namespace facet::reference
