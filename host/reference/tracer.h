#pragma once
// One sample from the camera to its radiance, by every integrator (docs/reference/sampling.md).
#include <optional>
#include <vector>

#include "reference/first_surface.h"
#include "reference/scene_rays.h"
#include "reference/world.h"

namespace facet::reference {

/// Follows one sample of a scene. Real: the precision. Probe: what watches.
template <typename Real, typename Probe>
class Tracer {
 public:
  Tracer(const World<Real>& world, const SampleId& id, Probe& probe)
      : world_(world),
        integrator_(world.integrator),
        candidates_(static_cast<Real>(world.integrator.candidates())),
        id_(id),
        probe_(probe),
        rays_(world, probe) {}

  /// Radiance in W sr^-1 m^-2 (or what the integrator shows) along the sample's ray through pixel
  /// (x, y).
  [[nodiscard]] Vec3<Real> radiance(int x, int y) {
    probe_.at_ray(0);
    const Ray<Real> ray = world_.camera.ray(x, y, world_.camera.filter_sample(id_), probe_);
    FirstSurface<Real, Probe> first(rays_, integrator_, id_, probe_);
    switch (integrator_.type.kernel) {
      case INTEGRATOR_normals:
        return first.normals(ray);
      case INTEGRATOR_depth:
        return first.depth(ray);
      case INTEGRATOR_ambient_occlusion:
        return first.ambient_occlusion(ray);
      case INTEGRATOR_simple:
        return first.simple(ray);
      default:
        return radiance_along(ray);
    }
  }

  [[nodiscard]] const RayCounts& counts() const { return rays_.counts(); }

 private:
  enum Kernel {
#define FACET_KERNEL(name, id) INTEGRATOR_##name = id,
    FACET_INTEGRATOR_KERNEL_LIST(FACET_KERNEL)
#undef FACET_KERNEL
  };

  /// A surface that a ray has found, with the shading frame and the direction back to the viewer in
  /// it.
  struct Interaction {
    Surface<Real> surface;
    Frame<Real> frame;
    Vec3<Real> wo;
    AnyBsdf<Real> bsdf;  ///< seen from wo's side
  };

  /// The ray that comes next, and what its path has gone through.
  struct Path {
    Ray<Real> ray;
    Vec3<Real> throughput{1};
    Real pdf = 0;           ///< of the ray's direction, sr^-1, or delta_pdf
    Receiver<Real> from{};  ///< where the ray leaves a surface
    Real eta2 = 1;          ///< product of (eta_i/eta_o)^2 of all refractions
  };

  /// MIS weight of a sample of density `used` where another strategy has density `other`: 1/(1 +
  /// r), r their ratio, or its square under the power heuristic (E. Veach, L. Guibas 1995).
  [[nodiscard]] Real weight(Real used, Real other) const {
    if (!(used > 0)) return 0;
    const Real r = other / used;
    return 1 / (1 + (integrator_.heuristic == Heuristic::power ? r * r : r));
  }

  /// An emitter sample with what it contributes to a path of throughput 1 where nothing stands in
  /// its way.
  struct Light {
    EmitterSample<Real> sample;
    Vec3<Real> unshadowed{0};
    bool weighted = false;  ///< by MIS
  };

  [[nodiscard]] Light light_of(const EmitterSample<Real>& e, const Interaction& at) {
    Light light{e};
    const Vec3<Real> wi = probe_.nudged(at.frame.to_local(e.direction));
    if (!(e.pdf > 0)) return light;
    light.unshadowed = at.bsdf.eval(at.wo, wi, probe_) * e.radiance * (std::abs(wi.z) / e.pdf);
    light.weighted = integrator_.type.material_sampling && !e.is_point;
    if (light.weighted)
      light.unshadowed *= weight(candidates_ * e.pdf, at.bsdf.pdf(at.wo, wi, probe_));
    return light;
  }

  /// What of it arrives.
  [[nodiscard]] Vec3<Real> arriving(const Light& light, const Interaction& at) {
    if (light.unshadowed == Vec3<Real>(0)) return light.unshadowed;
    const EmitterSample<Real>& e = light.sample;
    Ray<Real> shadow{at.surface.origin_towards(e.direction, 0, probe_), e.direction};
    if (!e.at_infinity) {
      shadow.direction = probe_.nudged(e.end - shadow.origin);
      shadow.t_max = 1;
    }
    if (rays_.occluded(shadow)) {
      probe_.uses(Part::blocked_shadow_ray, 0);
      return Vec3<Real>(0);
    }
    // What does not contribute cannot be at fault.
    probe_.uses(Part::emitter_sample, e.emitter);
    probe_.uses(Part::bsdf_eval, at.bsdf.type());
    if (light.weighted) probe_.uses(Part::bsdf_pdf, at.bsdf.type());
    return light.unshadowed;
  }

  /// The emitter sample of interaction k: one of the candidates, by the luminance of what each
  /// contributes unshadowed, which then stands for all of them.
  [[nodiscard]] Light chosen_light(const Interaction& at, std::uint32_t k) {
    const auto count = static_cast<std::uint32_t>(integrator_.candidates());
    const Block first = bounce_block(id_, k, shared::BOUNCE_EMITTER);
    std::array<Light, shared::LARGEST_CANDIDATES> lights;
    std::array<Real, shared::LARGEST_CANDIDATES> weights{};
    Real sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      probe_.at_ray(2 * k - 1, i);
      const Block block = first.candidate(i, count);
      lights[i] = light_of(world_.sample_emitter(at.surface, receiver(at), block, probe_), at);
      const Vec3<Real>& c = lights[i].unshadowed;
      weights[i] = Real(0.2126) * c.x + Real(0.7152) * c.y + Real(0.0722) * c.z;
      sum += weights[i];
    }
    if (count == 1 || !(sum > 0)) return lights[0];
    const Real share = block_of(id_, shared::BLOCK_CANDIDATES + k - 1).template number<Real>(0);
    std::uint32_t chosen = 0;
    Real before = 0;
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
      probe_.at_ray(2 * k - 1, i);
      before += weights[i];
      const auto margin = static_cast<double>(share - before / sum);
      if (probe_.decide(DecisionKind::candidate, 0, share * sum >= before, margin)) ++chosen;
    }
    probe_.at_ray(2 * k - 1, chosen);
    lights[chosen].unshadowed *= sum / (static_cast<Real>(count) * weights[chosen]);
    return lights[chosen];
  }

  /// Adds the light of emitter samples at interaction k.
  void add_emitter_samples(const Interaction& at, std::uint32_t k, const Vec3<Real>& throughput,
                           Vec3<Real>& radiance) {
    if (!integrator_.type.every_emitter) {
      radiance += throughput * arriving(chosen_light(at, k), at);
      return;
    }
    const std::size_t count = world_.scene.emitters.size();
    for (std::size_t e = 0; e < count; ++e) {
      probe_.at_ray(2 * k - 1, e);
      const Block block = emitter_block(id_, k, e, count);
      const EmitterSample<Real> sample =
          world_.sample_emitter(e, at.surface, EmitterNumbers(block), probe_);
      radiance += throughput * arriving(light_of(sample, at), at);
    }
  }

  /// Whether a path goes on after interaction k; divides its throughput by the probability.
  [[nodiscard]] bool survives(Path& path, std::uint32_t k, std::uint32_t word) {
    if (!integrator_.type.every_emitter && k < shared::ROULETTE_FIRST) return true;
    probe_.uses(Part::roulette, 0);
    auto q = static_cast<Real>(0.95);
    if (!integrator_.type.every_emitter) {
      const Vec3<Real>& t = path.throughput;
      q = std::min(1 - 2 / static_cast<Real>(k + 60),
                   probe_.nudged(path.eta2 * std::max({t.x, t.y, t.z})));
    }
    // A whole number of words, of which there are 2^32.
    const double words = std::max(1.0, std::floor(std::ldexp(static_cast<double>(q), 32)));
    const double probability = std::ldexp(words, -32);
    path.throughput /= static_cast<Real>(probability);
    return probe_.below(DecisionKind::roulette, std::ldexp(static_cast<double>(word), -32),
                        probability);
  }

  /// What a ray finds: emission, weighted by how else it would have been found.
  [[nodiscard]] Vec3<Real> weighted(const Found<Real>& found, std::uint32_t k, Real pdf) const {
    if (found.emitter == none) return Vec3<Real>(0);
    if (k == 1) {
      probe_.uses(Part::emission_seen, found.emitter);
      return found.radiance;
    }
    const bool by_delta = pdf == delta_pdf<Real>;
    if (!by_delta && !integrator_.type.material_sampling) return Vec3<Real>(0);
    probe_.uses(Part::emission_found, found.emitter);
    if (by_delta || !samples_emitters()) return found.radiance;
    return found.radiance * weight(pdf, candidates_ * found.pdf);
  }

  [[nodiscard]] bool samples_emitters() const {
    return integrator_.type.emitter_sampling && !world_.scene.emitters.empty();
  }

  /// Whether a path goes on at an interaction, if only to look for emission.
  [[nodiscard]] bool follows(bool delta, bool is_last) const {
    if (delta) return true;
    return !integrator_.type.every_emitter && !(is_last && !integrator_.type.material_sampling);
  }

  [[nodiscard]] Vec3<Real> radiance_along(const Ray<Real>& first) {
    const int limit = integrator_.interaction_limit();
    const std::uint32_t last = limit < 0 ? none : static_cast<std::uint32_t>(limit);
    Vec3<Real> radiance(0);
    Path path{first};
    for (std::uint32_t k = 1;; ++k) {
      probe_.at_ray(2 * (k - 1));
      const Vec3<Real>& d = path.ray.direction;
      const Hit<Real> hit = rays_.closest(path.ray);
      if (hit.triangle == none)
        return radiance +
               path.throughput *
                   weighted(world_.emission_from_afar(path.from, d, probe_), k, path.pdf);
      const Surface<Real> s = rays_.surface_of(hit);
      radiance += path.throughput *
                  weighted(world_.emission_of(s, path.from, d, hit.t, probe_), k, path.pdf);
      if (k > last) return radiance;
      const std::optional<Interaction> at = interaction(s, d);
      if (!at) return radiance;
      const bool delta = at->bsdf.delta();
      if (samples_emitters() && !delta) add_emitter_samples(*at, k, path.throughput, radiance);
      if (!follows(delta, k >= last)) return radiance;
      probe_.at_ray(2 * k);
      if (!scatter(*at, k, path)) return radiance;
    }
  }

  /// The surface seen by a ray in direction d; nothing where that is its dark side.
  [[nodiscard]] std::optional<Interaction> interaction(const Surface<Real>& s,
                                                       const Vec3<Real>& d) {
    const Frame<Real> frame = s.frame(probe_);
    const Vec3<Real> wo = probe_.nudged(frame.to_local(-d));
    Interaction at{s, frame, wo, world_.bsdf_of(s, probe_)};
    if (probe_.positive(DecisionKind::horizon, wo.z, 1)) return at;
    if (!at.bsdf.transmits() || wo.z == 0) return std::nullopt;
    at.bsdf.turn_over();
    return at;
  }

  /// The ray that continues the path from interaction k.
  [[nodiscard]] bool scatter(const Interaction& at, std::uint32_t k, Path& path) {
    const Block block = bounce_block(id_, k, shared::BOUNCE_BSDF);
    const BsdfNumbers numbers(block);
    probe_.uses(Part::bsdf_sample, at.bsdf.type());
    const BsdfSample<Real> sample = at.bsdf.sample(at.wo, numbers, probe_);
    path.throughput *= sample.weight;
    if (path.throughput == Vec3<Real>(0)) return false;
    path.pdf = sample.pdf;
    path.eta2 *= sample.eta2;
    if (!survives(path, k, block.word(shared::BSDF_ROULETTE))) return false;
    const Vec3<Real> d = probe_.nudged(at.frame.to_world(probe_.nudged(sample.wi)));
    path.ray = {at.surface.origin_towards(d, 2, probe_), d};
    path.from = receiver(at);
    path.from.point = path.ray.origin;
    return true;
  }

  /// An interaction as a light tree sees it.
  [[nodiscard]] static Receiver<Real> receiver(const Interaction& at) {
    return {at.surface.position, at.bsdf.transmits() ? Vec3<Real>(0) : at.surface.ns};
  }

  const World<Real>& world_;
  const Integrator& integrator_;
  Real candidates_;  ///< of an emitter sample
  SampleId id_;
  Probe& probe_;
  SceneRays<Real, Probe> rays_;
};

}  // namespace facet::reference
