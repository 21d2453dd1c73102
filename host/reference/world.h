#pragma once
// The scene in the reference's precision, with what is worked out once for all samples.
#include <deque>
#include <optional>

#include "reference/bsdf/bsdf.h"
#include "reference/camera.h"
#include "reference/emitter/area.h"
#include "reference/emitter/environment.h"

namespace facet::reference {

/// Keeps a reference to the scene, which must outlive it.
template <typename Real>
class World {
 public:
  World(const Scene& parsed, LobeSampling sampling) : scene(parsed), geometry(parsed), camera(parsed.camera) {
    for (const Bsdf& b : parsed.bsdfs) bsdfs.emplace_back(b, sampling);
    std::vector<double> weights;
    for (const Emitter& emitter : parsed.emitters) {
      const double power = add_emitter(emitter);
      weights.push_back(parsed.emitter_selection == EmitterSelection::uniform && power > 0 ? 1 : power);
    }
    choice_ = Choice(weights);
  }

  /// A direction from a surface towards some emitter; the density includes the choice of the emitter.
  template <typename Probe>
  [[nodiscard]] EmitterSample<Real> sample_emitter(const Surface<Real>& from, const Block& block,
                                                   Probe& probe) const {
    const std::size_t chosen = choice_.choose(block.word(shared::EMITTER_CHOICE)).entry;
    // Where no emitter has power, none is sampled.
    if (!(choice_.probability(chosen) > 0)) return {};
    const auto& light = lights_[chosen];
    EmitterSample<Real> s = light ? light->sample(from, block, probe) : environment_->sample(block, probe);
    s.emitter = chosen;
    s.pdf *= static_cast<Real>(choice_.probability(chosen));
    return s;
  }

  /// What a ray in direction d finds on the surface that it hits at the given distance.
  template <typename Probe>
  [[nodiscard]] Found<Real> emission_of(const Surface<Real>& s, const Vec3<Real>& d, Real distance,
                                        Probe& probe) const {
    const std::uint32_t emitter = scene.meshes[s.mesh].emitter;
    if (emitter == none) return {};
    const AreaLight<Real>& light = *lights_[emitter];
    return {emitter, light.emission(s, d, probe),
            light.pdf(s, d, distance) * static_cast<Real>(choice_.probability(emitter))};
  }

  /// What a ray finds that leaves the scene.
  template <typename Probe>
  [[nodiscard]] Found<Real> emission_from_afar(const Vec3<Real>& d, Probe& probe) const {
    if (!environment_) return {};
    Found<Real> found = environment_->find(d, probe);
    found.emitter = environment_index_;
    found.pdf *= static_cast<Real>(choice_.probability(environment_index_));
    return found;
  }

  const Scene& scene;
  Geometry<Real> geometry;
  PerspectiveCamera<Real> camera;
  std::vector<AnyBsdf<Real>> bsdfs;

 private:
  /// Returns its power.
  double add_emitter(const Emitter& emitter) {
    lights_.emplace_back();
    if (const auto* area = std::get_if<AreaEmitter>(&emitter)) {
      lights_.back().emplace(scene, geometry, *area);
      return lights_.back()->power();
    }
    environment_.emplace(std::get<EnvironmentEmitter>(emitter));
    environment_index_ = static_cast<std::uint32_t>(lights_.size() - 1);
    const double radius = geometry.triangles.empty() ? 1 : glm::length(dvec3(geometry.bounds.extent())) / 2;
    return 4 * pi<double> * pi<double> * radius * radius * environment_->mean_luminance();
  }

  std::deque<std::optional<AreaLight<Real>>> lights_;  ///< by emitter; empty for the environment
  std::optional<Environment<Real>> environment_;
  std::uint32_t environment_index_ = none;
  Choice choice_;
};

}  // namespace facet::reference
