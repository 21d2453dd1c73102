#pragma once
// What the rays of one sample find in a scene, under the eyes of a probe.
#include "reference/watched_intersect.h"
#include "reference/world.h"

namespace facet::reference {

struct RayCounts {
  std::uint64_t closest = 0;
  std::uint64_t any = 0;
};

/// Traces the rays of one sample and counts them. Real: the precision. Probe: what watches.
template <typename Real, typename Probe>
class SceneRays {
 public:
  SceneRays(const World<Real>& world, Probe& probe) : world_(world), probe_(probe) {}

  /// The first triangle along a ray, if any.
  [[nodiscard]] Hit<Real> closest(const Ray<Real>& ray) {
    ++counts_.closest;
    Hit<Real> hit;
    if constexpr (Probe::watches) {
      hit = closest_hit(world_.geometry, ray, probe_);
      if (hit.triangle != none) nudge(hit);
    } else {
      hit = closest_hit(world_.geometry, ray);
    }
    probe_.found(hit.triangle);
    return hit;
  }

  /// Whether anything lies along a ray.
  [[nodiscard]] bool occluded(const Ray<Real>& ray) {
    ++counts_.any;
    bool found = false;
    if constexpr (Probe::watches) {
      found = any_hit(world_.geometry, ray, probe_);
    } else {
      found = any_hit(world_.geometry, ray);
    }
    probe_.found(found ? 1 : 0);
    return found;
  }

  /// The surface at a hit.
  [[nodiscard]] Surface<Real> surface_of(const Hit<Real>& hit) {
    probe_.uses(Part::mesh, world_.geometry.triangles[hit.triangle].mesh);
    return surface_at(world_.scene, world_.geometry.triangles[hit.triangle], hit.b1, hit.b2,
                      probe_);
  }

  [[nodiscard]] const RayCounts& counts() const { return counts_; }

 private:
  /// Moves a hit by an ulp of the way to it, which is what its test has rounded, but at least by
  /// one of the weights.
  void nudge(Hit<Real>& hit) {
    const auto& v = world_.geometry.triangles[hit.triangle].vertices;
    const Real edge =
        std::min({glm::length(v[1] - v[0]), glm::length(v[2] - v[1]), glm::length(v[0] - v[2])});
    const Real ulps = std::max(Real(1), hit.t / edge);
    hit.b1 += (probe_.nudged(Real(1)) - 1) * ulps;
    hit.b2 += (probe_.nudged(Real(1)) - 1) * ulps;
  }

  const World<Real>& world_;
  Probe& probe_;
  RayCounts counts_;
};

}  // namespace facet::reference
