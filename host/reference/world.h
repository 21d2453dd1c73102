#pragma once
// The scene in the reference's precision, with what is worked out once for all samples.
#include <algorithm>
#include <deque>
#include <variant>

#include "reference/bsdf/bsdf.h"
#include "reference/camera.h"
#include "reference/emitter/area.h"
#include "reference/emitter/environment.h"
#include "reference/emitter/point.h"
#include "scene/settings.h"

namespace facet::reference {

/// Keeps a reference to the scene, which must outlive it.
template <typename Real>
class World {
 public:
  World(const Scene& parsed, const RenderSettings& settings)
      : scene(parsed),
        integrator(settings.integrator),
        geometry(parsed),
        camera(camera_of(parsed, settings)),
        bsdfs_(bsdfs_of(parsed, settings)),
        lobes_(settings.sampling) {
    std::vector<double> weights;
    double total = 0;
    for (const Emitter& emitter : parsed.emitters) {
      weights.push_back(add_emitter(emitter));
      total += weights.back();
    }
    const auto shining =
        static_cast<double>(std::ranges::count_if(weights, [](double w) { return w > 0; }));
    for (double& w : weights) {
      if (!(w > 0)) continue;
      w = (settings.emitter_selection == EmitterSelection::power ? w / total : 0) + 1 / shining;
    }
    choice_ = Choice(weights);
  }

  /// The BSDF of a point, seen from above.
  template <typename Probe>
  [[nodiscard]] AnyBsdf<Real> bsdf_of(const Surface<Real>& s, Probe& probe) const {
    Parameters<Real, Probe> at(scene.textures, s.uv, probe);
    return {bsdfs_[scene.meshes[s.mesh].bsdf], at, lobes_};
  }

  /// A direction from a surface towards some emitter; the density includes the choice of the
  /// emitter.
  template <typename Probe>
  [[nodiscard]] EmitterSample<Real> sample_emitter(const Surface<Real>& from, const Block& block,
                                                   Probe& probe) const {
    EmitterNumbers numbers(block);
    const auto [chosen, remainder] = choice_.choose(numbers.u, numbers.first_fill);
    // Where no emitter has power, none is sampled.
    if (!(choice_.probability(chosen) > 0)) return {};
    numbers.u = remainder;
    EmitterSample<Real> s = sample_emitter(chosen, from, numbers, probe);
    s.pdf *= static_cast<Real>(choice_.probability(chosen));
    return s;
  }

  /// A direction from a surface towards emitter e.
  template <typename Probe>
  [[nodiscard]] EmitterSample<Real> sample_emitter(std::size_t e, const Surface<Real>& from,
                                                   const EmitterNumbers& numbers,
                                                   Probe& probe) const {
    EmitterSample<Real> s = std::visit(
        [&](const auto& light) { return light.sample(from, numbers, probe); }, lights_[e]);
    s.emitter = e;
    return s;
  }

  /// What a ray in direction d finds on the surface that it hits at the given distance.
  template <typename Probe>
  [[nodiscard]] Found<Real> emission_of(const Surface<Real>& s, const Vec3<Real>& d, Real distance,
                                        Probe& probe) const {
    const std::uint32_t emitter = scene.meshes[s.mesh].emitter;
    if (emitter == none) return {};
    const auto& light = std::get<AreaLight<Real>>(lights_[emitter]);
    return {emitter, light.emission(s, d, probe),
            light.pdf(s, d, distance) * static_cast<Real>(choice_.probability(emitter))};
  }

  /// What a ray finds that leaves the scene.
  template <typename Probe>
  [[nodiscard]] Found<Real> emission_from_afar(const Vec3<Real>& d, Probe& probe) const {
    if (environment_ == none) return {};
    Found<Real> found = std::get<Environment<Real>>(lights_[environment_]).find(d, probe);
    found.emitter = environment_;
    found.pdf *= static_cast<Real>(choice_.probability(environment_));
    return found;
  }

  const Scene& scene;
  Integrator integrator;
  Geometry<Real> geometry;
  PerspectiveCamera<Real> camera;

 private:
  using Light = std::variant<AreaLight<Real>, Environment<Real>, PointSource<Real>>;

  /// Returns its power.
  double add_emitter(const Emitter& emitter) {
    if (const auto* area = std::get_if<AreaEmitter>(&emitter)) {
      lights_.emplace_back(std::in_place_type<AreaLight<Real>>, scene, geometry, *area);
    } else if (const auto* point = std::get_if<PointLight>(&emitter)) {
      lights_.emplace_back(std::in_place_type<PointSource<Real>>, *point);
    } else {
      environment_ = static_cast<std::uint32_t>(lights_.size());
      lights_.emplace_back(std::in_place_type<Environment<Real>>,
                           std::get<EnvironmentEmitter>(emitter));
    }
    return std::visit([&](const auto& light) { return light.power(geometry.bounds); },
                      lights_.back());
  }

  std::vector<Bsdf> bsdfs_;
  LobeSampling lobes_;
  std::deque<Light> lights_;  ///< by emitter
  std::uint32_t environment_ = none;
  Choice choice_;
};

}  // namespace facet::reference
