#pragma once
// Which quantity is estimated, and how.
#include <facet/request.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/plugin/parameter.h"
#include "shared/integrator_list.h"

namespace facet {

/// One line of the shared list of integrators.
struct IntegratorType {
  std::string_view name;
  int kernel;              ///< id of the shading kernel
  bool emitter_sampling;   ///< direct light by sampling emitters
  bool every_emitter;      ///< each of them; paths then go on at delta lobes alone
  bool material_sampling;  ///< direct light by sampling BSDFs
  int interactions;        ///< most surface interactions, -1: unlimited
};

[[nodiscard]] const std::vector<IntegratorType>& integrator_types();
/// Nothing for an unknown name.
[[nodiscard]] std::optional<IntegratorType> find_integrator_type(std::string_view name);

struct Integrator {
  IntegratorType type{};
  int max_depth = -1;  ///< surface interactions, -1: unlimited
  Heuristic heuristic = Heuristic::balance;
  EmitterSelection emitter_selection = EmitterSelection::contribution;
  AreaSampling area_sampling = AreaSampling::area;
  EnvironmentSampling environment_sampling = EnvironmentSampling::compensated;
  int emitter_candidates = 1;  ///< as asked for; candidates() are those that there are
  vec3 position{0};            ///< of the light of `simple`
  Color energy{1};             ///< of that light, W

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    using namespace parameter;
    if (p.type.name == "simple") {
      visit("position", p.position, Point{}, "of the light");
      visit("energy", p.energy, NonNegativeColor{}, "of the light, W");
    }
    if (!p.needs_emitters()) return;
    visit("maxDepth", p.max_depth, Count{-1, 1 << 30}, "surface interactions, -1: unlimited");
    visit("heuristic", p.heuristic, Choice{heuristic_words},
          "MIS weights; power: beta = 2, Veach and Guibas 1995");
    visit("emitterSelection", p.emitter_selection, Choice{emitter_selection_words},
          "of an emitter sample: by what an emitter and its triangle can contribute to the shaded "
          "point, by the emitter's power, or each as often");
    visit("areaSampling", p.area_sampling, Choice{area_sampling_words},
          "of a point of an area emitter: by area, or by the solid angle that its triangles fill "
          "(Arvo 1995), which serves near large lights");
    visit("environmentSampling", p.environment_sampling, Choice{environment_sampling_words},
          "of directions towards an environment, where BSDFs are sampled as well: by what of its "
          "radiance exceeds the mean (MIS compensation, Karlik et al. 2019), or by its radiance");
    visit("emitterCandidates", p.emitter_candidates, Count{1, shared::LARGEST_CANDIDATES},
          "emitter samples of which one is taken and its shadow ray traced, by what it would "
          "contribute unshadowed (resampling, Talbot et al. 2005)");
  }

  /// Most surface interactions under both limits, -1: unlimited.
  [[nodiscard]] int interaction_limit() const {
    if (type.interactions < 0) return max_depth;
    return max_depth < 0 ? type.interactions : std::min(max_depth, type.interactions);
  }
  /// Whether emitters are to be chosen by what they contribute: where one of them is sampled.
  [[nodiscard]] bool wants_light_tree() const {
    return emitter_selection == EmitterSelection::contribution && type.emitter_sampling &&
           !type.every_emitter;
  }
  /// Emitter samples of which one is taken: where one of the emitters is sampled.
  [[nodiscard]] int candidates() const {
    return type.emitter_sampling && !type.every_emitter ? emitter_candidates : 1;
  }
  /// Whether an environment is sampled where it is brighter than its mean alone: where the samples
  /// of BSDFs find the rest.
  [[nodiscard]] bool compensates_environment() const {
    return environment_sampling == EnvironmentSampling::compensated && type.emitter_sampling &&
           type.material_sampling;
  }
  /// Whether light is estimated at all, so that a scene without emitters is black.
  [[nodiscard]] bool needs_emitters() const {
    return type.emitter_sampling || type.material_sampling;
  }
};

}  // namespace facet
