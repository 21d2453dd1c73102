#pragma once
// Intersection for samples that are watched: every triangle that a turned decision could bring in
// or out is looked at, and each near decision is logged.
#include "reference/intersect.h"

namespace facet::reference {

namespace detail {

/// Triangles are looked at when they are missed by less than this share of their size.
inline constexpr double near_miss = 0.2;
/// Decisions with larger margins than these are not logged: rounding does not reach so far.
inline constexpr double edge_log = 0.1;
inline constexpr double distance_log = 1e-3;

/// All hits of the ray within its range under the decisions of the watch.
template <typename Real>
std::vector<Hit<Real>> watched_hits(const Geometry<Real>& geometry, const Ray<Real>& ray,
                                    Watch& watch) {
  const Shear<Real> shear(ray.direction);
  const Real speed = std::sqrt(glm::dot(ray.direction, ray.direction));
  std::vector<Hit<Real>> hits;
  Ray<Real> wide = ray;
  wide.t_min = -unlimited<Real>;
  wide.t_max = unlimited<Real>;
  traverse(
      geometry.tree, wide, Real(near_miss), [&](std::uint32_t first, std::uint32_t count, Real&) {
        for (std::uint32_t i = first; i < first + count; ++i) {
          const Triangle<Real>& triangle = geometry.triangles[i];
          const PlaneHit<Real> plane = meet_plane(shear, ray, triangle);
          if (!plane.valid) continue;
          bool hit = plane.inside;
          const auto weight = static_cast<double>(plane.smallest_weight());
          if (std::abs(weight) < edge_log) hit = watch.decide(DecisionKind::edge, i, hit, weight);
          const auto within = [&](Real distance, std::uint64_t side) {
            const auto margin =
                static_cast<double>(distance * speed / std::max(triangle.magnitude, ulp(Real(0))));
            if (!(std::abs(margin) < distance_log)) return margin > 0;
            return watch.decide(DecisionKind::range, 2 * std::uint64_t{i} + side, margin > 0,
                                margin);
          };
          if (!hit || !within(plane.t - ray.t_min, 0)) continue;
          if (ray.t_max < unlimited<Real> && !within(ray.t_max - plane.t, 1)) continue;
          hits.push_back({plane.t, i, plane.b[1], plane.b[2]});
        }
        return false;
      });
  std::sort(hits.begin(), hits.end(),
            [](const Hit<Real>& a, const Hit<Real>& b) { return a.t < b.t; });
  return hits;
}

}  // namespace detail

template <typename Real>
[[nodiscard]] Hit<Real> closest_hit(const Geometry<Real>& geometry, const Ray<Real>& ray,
                                    Watch& watch) {
  const std::vector<Hit<Real>> hits = detail::watched_hits(geometry, ray, watch);
  if (hits.empty()) return {ray.t_max, none, 0, 0};
  std::size_t chosen = 0;
  for (std::size_t i = 1; i < hits.size(); ++i) {
    if (!(hits[i].t - hits[0].t < Real(detail::distance_log) * std::abs(hits[0].t))) break;
    // Asked as "is the triangle of the lower number nearer", so that perturbed runs ask the same.
    const bool lower_chosen = hits[chosen].triangle < hits[i].triangle;
    const Hit<Real>& lower = hits[lower_chosen ? chosen : i];
    const Hit<Real>& higher = hits[lower_chosen ? i : chosen];
    const std::uint64_t pair = (std::uint64_t{lower.triangle} << 32U) + higher.triangle;
    const auto margin = static_cast<double>((higher.t - lower.t) / std::abs(hits[0].t));
    if (watch.decide(DecisionKind::order, pair, margin >= 0, margin) != lower_chosen) chosen = i;
  }
  return hits[chosen];
}

template <typename Real>
[[nodiscard]] bool any_hit(const Geometry<Real>& geometry, const Ray<Real>& ray, Watch& watch) {
  return !detail::watched_hits(geometry, ray, watch).empty();
}

}  // namespace facet::reference
