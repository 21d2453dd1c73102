#pragma once
// One sample from the camera to its radiance, by every integrator (docs/sampling.md).
#include "reference/watched_intersect.h"
#include "reference/world.h"

namespace facet::reference {

struct RayCounts {
  std::uint64_t closest = 0;
  std::uint64_t any = 0;
};

/// Follows one sample of a scene. Real: the precision. Probe: what watches.
template <typename Real, typename Probe>
class Tracer {
 public:
  Tracer(const World<Real>& world, const SampleId& id, Probe& probe)
      : world_(world), integrator_(world.scene.integrator), id_(id), probe_(probe) {}

  /// Radiance in W sr^-1 m^-2 (or what the integrator shows) along the sample's ray through pixel (x, y).
  [[nodiscard]] Vec3<Real> radiance(int x, int y) {
    probe_.at_ray(0);
    const Ray<Real> ray = world_.camera.ray(x, y, world_.camera.filter_sample(id_), probe_);
    switch (integrator_.type.kernel) {
      case INTEGRATOR_normals:
        return normals(ray);
      case INTEGRATOR_depth:
        return depth(ray);
      case INTEGRATOR_ambient_occlusion:
        return ambient_occlusion(ray);
      default:
        return path(ray);
    }
  }

  [[nodiscard]] const RayCounts& counts() const { return counts_; }

 private:
  enum Kernel {
#define FACET_KERNEL(name, id) INTEGRATOR_##name = id,
    FACET_INTEGRATOR_KERNEL_LIST(FACET_KERNEL)
#undef FACET_KERNEL
  };

  /// A surface that a ray has found, with the shading frame and the direction back to the viewer in it.
  struct Interaction {
    Surface<Real> surface;
    Frame<Real> frame;
    Vec3<Real> wo;
    const AnyBsdf<Real>& bsdf;
  };

  [[nodiscard]] Hit<Real> closest(const Ray<Real>& ray) {
    ++counts_.closest;
    Hit<Real> hit;
    if constexpr (Probe::watches) {
      hit = closest_hit(world_.geometry, ray, probe_);
      hit.b1 += probe_.nudged(Real(1)) - 1;
      hit.b2 += probe_.nudged(Real(1)) - 1;
    } else {
      hit = closest_hit(world_.geometry, ray);
    }
    probe_.found(hit.triangle);
    return hit;
  }

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

  [[nodiscard]] Surface<Real> surface_of(const Hit<Real>& hit) {
    probe_.uses(Part::mesh, world_.geometry.triangles[hit.triangle].mesh);
    return surface_at(world_.scene, world_.geometry.triangles[hit.triangle], hit.b1, hit.b2, probe_);
  }

  [[nodiscard]] Vec3<Real> normals(const Ray<Real>& ray) {
    const Hit<Real> hit = closest(ray);
    return hit.triangle == none ? Vec3<Real>(0) : glm::abs(surface_of(hit).ns);
  }

  [[nodiscard]] Vec3<Real> depth(const Ray<Real>& ray) {
    const Hit<Real> hit = closest(ray);
    return Vec3<Real>(hit.triangle == none ? Real(0) : hit.t);
  }

  [[nodiscard]] Vec3<Real> ambient_occlusion(const Ray<Real>& ray) {
    const Hit<Real> hit = closest(ray);
    if (hit.triangle == none) return Vec3<Real>(0);
    Surface<Real> s = surface_of(hit);
    const Real cosine = glm::dot(s.ns, ray.direction);
    // Both sides see the sky.
    if (!probe_.decide(DecisionKind::horizon, 0, cosine < 0, static_cast<double>(cosine))) s.ns = -s.ns;
    const Block block = bounce_block(id_, 1, shared::BOUNCE_BSDF);
    const Vec3<Real> local =
        cosine_direction(block.number<Real>(shared::BSDF_U), block.number<Real>(shared::BSDF_V));
    const Vec3<Real> d = probe_.nudged(s.frame(probe_).to_world(local));
    probe_.at_ray(1);
    return Vec3<Real>(occluded({s.origin_towards(d, 0, probe_), d}) ? 0 : 1);
  }

  /// MIS weight of a sample of density `used` where another strategy has density `other`: 1/(1 + r), r their
  /// ratio, or its square under the power heuristic (E. Veach, L. Guibas 1995).
  [[nodiscard]] Real weight(Real used, Real other) const {
    if (!(used > 0)) return 0;
    const Real r = other / used;
    return 1 / (1 + (integrator_.heuristic == Heuristic::power ? r * r : r));
  }

  /// Light by way of one emitter sample at interaction k, for a path of throughput 1.
  [[nodiscard]] Vec3<Real> emitter_estimate(const Interaction& at, std::uint32_t k) {
    const Surface<Real>& s = at.surface;
    const Block block = bounce_block(id_, k, shared::BOUNCE_EMITTER);
    const EmitterSample<Real> e = world_.sample_emitter(s, block, probe_);
    const Vec3<Real> wi = probe_.nudged(at.frame.to_local(e.direction));
    if (!above(wi) || !(e.pdf > 0)) return Vec3<Real>(0);
    Vec3<Real> light = at.bsdf.eval(at.wo, wi, probe_) * e.radiance * (wi.z / e.pdf);
    if (integrator_.type.material_sampling) light *= weight(e.pdf, at.bsdf.pdf(at.wo, wi, probe_));
    if (light == Vec3<Real>(0)) return light;
    Ray<Real> shadow{s.origin_towards(e.direction, 0, probe_), e.direction};
    if (!e.at_infinity) {
      shadow.direction = probe_.nudged(e.end - shadow.origin);
      shadow.t_max = 1;
    }
    if (occluded(shadow)) {
      probe_.uses(Part::blocked_shadow_ray, 0);
      return Vec3<Real>(0);
    }
    // What does not contribute cannot be at fault.
    probe_.uses(Part::emitter_sample, e.emitter);
    probe_.uses(Part::bsdf_eval, at.bsdf.type());
    if (integrator_.type.material_sampling) probe_.uses(Part::bsdf_pdf, at.bsdf.type());
    return light;
  }

  [[nodiscard]] bool above(const Vec3<Real>& w) {
    return probe_.decide(DecisionKind::horizon, 0, w.z > 0, static_cast<double>(w.z));
  }

  /// Whether a path goes on after interaction k; divides its throughput by the probability.
  [[nodiscard]] bool survives(Vec3<Real>& throughput, std::uint32_t k, Real u) {
    if (k < shared::ROULETTE_FIRST) return true;
    probe_.uses(Part::roulette, 0);
    const Real largest = std::max({throughput.x, throughput.y, throughput.z});
    const Real q = std::min(Real(0.95), probe_.nudged(largest));
    throughput /= q;
    return probe_.decide(DecisionKind::roulette, 0, u < q, static_cast<double>(q - u));
  }

  /// What a ray finds: emission, weighted by how else it would have been found.
  [[nodiscard]] Vec3<Real> weighted(const Found<Real>& found, std::uint32_t k, Real pdf) const {
    if (found.emitter == none) return Vec3<Real>(0);
    if (k == 1) {
      probe_.uses(Part::emission_seen, found.emitter);
      return found.radiance;
    }
    if (!integrator_.type.material_sampling) return Vec3<Real>(0);
    probe_.uses(Part::emission_found, found.emitter);
    if (!samples_emitters()) return found.radiance;
    return found.radiance * weight(pdf, found.pdf);
  }

  [[nodiscard]] bool samples_emitters() const {
    return integrator_.type.emitter_sampling && !world_.scene.emitters.empty();
  }

  [[nodiscard]] Vec3<Real> path(Ray<Real> ray) {
    const int limit = integrator_.interaction_limit();
    const std::uint32_t last = limit < 0 ? none : static_cast<std::uint32_t>(limit);
    Vec3<Real> radiance(0);
    Vec3<Real> throughput(1);
    Real pdf = 0;
    for (std::uint32_t k = 1;; ++k) {
      probe_.at_ray(2 * (k - 1));
      const Hit<Real> hit = closest(ray);
      if (hit.triangle == none)
        return radiance + throughput * weighted(world_.emission_from_afar(ray.direction, probe_), k, pdf);
      const Surface<Real> s = surface_of(hit);
      radiance += throughput * weighted(world_.emission_of(s, ray.direction, hit.t, probe_), k, pdf);
      const Frame<Real> frame = s.frame(probe_);
      const Vec3<Real> wo = probe_.nudged(frame.to_local(-ray.direction));
      if (k > last || !probe_.decide(DecisionKind::horizon, 1, wo.z > 0, static_cast<double>(wo.z)))
        return radiance;
      const Interaction at{s, frame, wo, world_.bsdfs[world_.scene.meshes[s.mesh].bsdf]};
      if (samples_emitters()) {
        probe_.at_ray(2 * k - 1);
        radiance += throughput * emitter_estimate(at, k);
      }
      if (k >= last && !integrator_.type.material_sampling) return radiance;
      probe_.at_ray(2 * k);
      if (!scatter(at, k, throughput, pdf, ray)) return radiance;
    }
  }

  /// The ray that continues the path from interaction k.
  [[nodiscard]] bool scatter(const Interaction& at, std::uint32_t k, Vec3<Real>& throughput, Real& pdf,
                             Ray<Real>& ray) {
    const Block block = bounce_block(id_, k, shared::BOUNCE_BSDF);
    const BsdfNumbers<Real> numbers{block.number<Real>(shared::BSDF_LOBE), block.number<Real>(shared::BSDF_U),
                                    block.number<Real>(shared::BSDF_V)};
    probe_.uses(Part::bsdf_sample, at.bsdf.type());
    BsdfSample<Real> sample = at.bsdf.sample(at.wo, numbers, probe_);
    sample.wi = probe_.nudged(sample.wi);
    if (!above(sample.wi)) return false;
    throughput *= sample.weight;
    if (throughput == Vec3<Real>(0)) return false;
    pdf = sample.pdf;
    if (!survives(throughput, k, block.number<Real>(shared::BSDF_ROULETTE))) return false;
    const Vec3<Real> d = probe_.nudged(at.frame.to_world(sample.wi));
    ray = {at.surface.origin_towards(d, 2, probe_), d};
    return true;
  }

  const World<Real>& world_;
  const Integrator& integrator_;
  SampleId id_;
  Probe& probe_;
  RayCounts counts_;
};

}  // namespace facet::reference
