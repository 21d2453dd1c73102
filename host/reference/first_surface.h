#pragma once
// Integrators that look at the first surface alone, and at what stands between it and the light.
#include "reference/scene_rays.h"
#include "reference/world.h"

namespace facet::reference {

/// What each shows along a sample's first ray; black where that finds nothing. Real: the precision.
/// Probe: what watches.
template <typename Real, typename Probe>
class FirstSurface {
 public:
  FirstSurface(SceneRays<Real, Probe>& rays, const Integrator& integrator, const SampleId& id,
               Probe& probe)
      : rays_(rays), integrator_(integrator), id_(id), probe_(probe) {}

  [[nodiscard]] Vec3<Real> normals(const Ray<Real>& ray) {
    const Hit<Real> hit = rays_.closest(ray);
    return hit.triangle == none ? Vec3<Real>(0) : glm::abs(rays_.surface_of(hit).ns);
  }

  [[nodiscard]] Vec3<Real> depth(const Ray<Real>& ray) {
    const Hit<Real> hit = rays_.closest(ray);
    return Vec3<Real>(hit.triangle == none ? Real(0) : hit.t);
  }

  [[nodiscard]] Vec3<Real> ambient_occlusion(const Ray<Real>& ray) {
    const Hit<Real> hit = rays_.closest(ray);
    if (hit.triangle == none) return Vec3<Real>(0);
    Surface<Real> s = rays_.surface_of(hit);
    const Real cosine = glm::dot(s.ns, ray.direction);
    // Both sides see the sky.
    if (!probe_.negative(DecisionKind::horizon, cosine)) s.ns = -s.ns;
    const Block block = bounce_block(id_, 1, shared::BOUNCE_BSDF);
    const Vec3<Real> local =
        cosine_direction(block.number<Real>(shared::BSDF_U), block.number<Real>(shared::BSDF_V));
    const Vec3<Real> d = probe_.nudged(s.frame(probe_).to_world(local));
    probe_.at_ray(1);
    return Vec3<Real>(rays_.occluded({s.origin_towards(d, 0, probe_), d}) ? 0 : 1);
  }

  [[nodiscard]] Vec3<Real> simple(const Ray<Real>& ray) {
    const Hit<Real> hit = rays_.closest(ray);
    if (hit.triangle == none) return Vec3<Real>(0);
    const Surface<Real> s = rays_.surface_of(hit);
    const Vec3<Real> position(integrator_.position);
    const Vec3<Real> way = position - s.position;
    const Vec3<Real> w = probe_.nudged(unit(way));
    const Real cosine = glm::dot(s.ns, w);
    if (!probe_.positive(DecisionKind::horizon, cosine)) return Vec3<Real>(0);
    probe_.at_ray(1);
    const Vec3<Real> origin = s.origin_towards(w, 0, probe_);
    if (rays_.occluded({origin, probe_.nudged(position - origin), 0, 1})) return Vec3<Real>(0);
    return Vec3<Real>(integrator_.energy) / (4 * pi<Real> * pi<Real>)*(cosine / glm::dot(way, way));
  }

 private:
  SceneRays<Real, Probe>& rays_;
  const Integrator& integrator_;
  SampleId id_;
  Probe& probe_;
};

}  // namespace facet::reference
