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
  vec3 position{0};  ///< of the light of `simple`
  Color energy{1};   ///< of that light, W

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
  /// Whether light is estimated at all, so that a scene without emitters is black.
  [[nodiscard]] bool needs_emitters() const {
    return type.emitter_sampling || type.material_sampling;
  }
};

}  // namespace facet
