#pragma once
// The scene in the reference's precision, with what is worked out once for all samples.
#include <algorithm>
#include <deque>
#include <variant>

#include "reference/bsdf/bsdf.h"
#include "reference/camera.h"
#include "reference/emitter/area.h"
#include "reference/emitter/environment.h"
#include "reference/emitter/light_tree.h"
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
      w = (integrator.emitter_selection == EmitterSelection::power ? w / total : 0) + 1 / shining;
    }
    choice_ = Choice(weights);
    if (integrator.wants_light_tree()) plant_tree();
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
  [[nodiscard]] EmitterSample<Real> sample_emitter(const Surface<Real>& from,
                                                   const Receiver<Real>& at, const Block& block,
                                                   Probe& probe) const {
    EmitterNumbers numbers(block);
    if (!tree_.empty()) return sample_by_contribution(from, at, numbers, probe);
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

  /// What a ray in direction d from a receiver finds on the surface that it hits at the given
  /// distance.
  template <typename Probe>
  [[nodiscard]] Found<Real> emission_of(const Surface<Real>& s, const Receiver<Real>& from,
                                        const Vec3<Real>& d, Real distance, Probe& probe) const {
    const std::uint32_t emitter = scene.meshes[s.mesh].emitter;
    if (emitter == none) return {};
    const auto& light = std::get<AreaLight<Real>>(lights_[emitter]);
    if (!tree_.empty()) {
      const std::size_t source = source_of_[emitter][light.piece_of(s.index)];
      const Real p = source == no_source ? Real(0) : tree_.probability(source, from, probe);
      return {emitter, light.emission(s, d, probe),
              light.pdf_in_piece(s, from.point, d, distance, probe) * p *
                  (1 - environment_share(from, probe))};
    }
    return {emitter, light.emission(s, d, probe),
            light.pdf(s, from.point, d, distance, probe) *
                static_cast<Real>(choice_.probability(emitter))};
  }

  /// What a ray from a receiver finds that leaves the scene.
  template <typename Probe>
  [[nodiscard]] Found<Real> emission_from_afar(const Receiver<Real>& from, const Vec3<Real>& d,
                                               Probe& probe) const {
    if (environment_ == none) return {};
    Found<Real> found = std::get<Environment<Real>>(lights_[environment_]).find(d, probe);
    found.emitter = environment_;
    found.pdf *= tree_.empty() ? static_cast<Real>(choice_.probability(environment_))
                               : environment_share(from, probe);
    return found;
  }

  const Scene& scene;
  Integrator integrator;
  Geometry<Real> geometry;
  PerspectiveCamera<Real> camera;

 private:
  static constexpr std::size_t no_source = static_cast<std::size_t>(-1);

  /// A source of the tree: a piece of a mesh, or a point light.
  struct Origin {
    std::size_t emitter;
    std::size_t piece;
  };

  void plant_tree() {
    std::vector<LightSource> sources;
    std::vector<double> weights;
    source_of_.resize(lights_.size());
    const auto add = [&](const LightSource& source, double weight, const Origin& origin) {
      source_of_[origin.emitter].push_back(source.energy > 0 ? sources.size() : no_source);
      if (!(source.energy > 0)) return;
      sources.push_back(source);
      weights.push_back(weight);
      origins_.push_back(origin);
    };
    for (std::size_t e = 0; e < lights_.size(); ++e) {
      if (const auto* point = std::get_if<PointSource<Real>>(&lights_[e])) {
        add(point->source(), 1, {e, 0});
      } else if (const auto* area = std::get_if<AreaLight<Real>>(&lights_[e])) {
        for (std::size_t p = 0; p < area->piece_count(); ++p)
          add(area->source(p), area->piece_area(p), {e, p});
      }
    }
    const double sky =
        environment_ == none ? 0 : std::get<Environment<Real>>(lights_[environment_]).irradiance();
    if (sources.size() < 2) return;
    tree_ = LightChooser(sources, weights);
    sky_ = static_cast<Real>(sky / tree_.energy());
  }

  /// Probability of the environment beside the tree.
  template <typename Probe>
  [[nodiscard]] Real environment_share(const Receiver<Real>& at, Probe& probe) const {
    if (!(sky_ > 0)) return 0;
    const Real others = tree_.importance(at);
    if (!(others > 0)) return 1;
    const double share = share_of_first(sky_, probe.nudged(others), DecisionKind::light, 0, probe);
    return static_cast<Real>(std::clamp(share, 0.25, 0.75));
  }

  template <typename Probe>
  [[nodiscard]] EmitterSample<Real> sample_by_contribution(const Surface<Real>& from,
                                                           const Receiver<Real>& at,
                                                           EmitterNumbers numbers,
                                                           Probe& probe) const {
    const Real sky = environment_share(at, probe);
    const TwoWayChoice choice(static_cast<double>(sky));
    if (sky > 0) {
      const bool is_sky = choice.is_first(numbers.u);
      numbers.u = choice.remainder(is_sky, numbers.u, numbers.first_fill);
      if (is_sky) {
        EmitterSample<Real> s = sample_emitter(environment_, from, numbers, probe);
        s.pdf *= sky;
        return s;
      }
    }
    const auto chosen = tree_.choose(at, numbers.u, numbers.first_fill, numbers.second_fill, probe);
    if (!(chosen.probability > 0)) return {};
    const Origin& origin = origins_[chosen.source];
    numbers.u = chosen.remainder;
    const auto* area = std::get_if<AreaLight<Real>>(&lights_[origin.emitter]);
    EmitterSample<Real> s =
        area == nullptr
            ? std::get<PointSource<Real>>(lights_[origin.emitter]).sample(from, numbers, probe)
            : area->sample_piece(origin.piece, numbers.u, numbers.v, numbers.second_fill, from,
                                 probe);
    s.emitter = origin.emitter;
    s.pdf *= chosen.probability * (1 - sky);
    return s;
  }

  using Light = std::variant<AreaLight<Real>, Environment<Real>, PointSource<Real>>;

  /// Returns its power.
  double add_emitter(const Emitter& emitter) {
    if (const auto* area = std::get_if<AreaEmitter>(&emitter)) {
      lights_.emplace_back(std::in_place_type<AreaLight<Real>>, scene, geometry, *area,
                           integrator.area_sampling);
    } else if (const auto* point = std::get_if<PointLight>(&emitter)) {
      lights_.emplace_back(std::in_place_type<PointSource<Real>>, *point);
    } else {
      environment_ = static_cast<std::uint32_t>(lights_.size());
      lights_.emplace_back(std::in_place_type<Environment<Real>>,
                           std::get<EnvironmentEmitter>(emitter),
                           integrator.compensates_environment());
    }
    return std::visit([&](const auto& light) { return light.power(geometry.bounds); },
                      lights_.back());
  }

  std::vector<Bsdf> bsdfs_;
  LobeSampling lobes_;
  std::deque<Light> lights_;  ///< by emitter
  std::uint32_t environment_ = none;
  Choice choice_;
  LightChooser tree_;                                ///< empty where emitters are chosen otherwise
  std::vector<Origin> origins_;                      ///< of the tree's sources
  std::vector<std::vector<std::size_t>> source_of_;  ///< of each emitter's pieces
  Real sky_ = 0;  ///< the environment's irradiance over the tree's energy
};

}  // namespace facet::reference
