#pragma once
// What whoever renders a scene can choose.
#include <facet/request.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/settings.h"

namespace facet::tradeoff {

/// A render, as far as it is chosen.
struct Plan {
  RenderRequest request;               ///< what differs from the scene's word
  std::optional<Precision> reference;  ///< the CPU reference instead of the kernels
};

/// The settings of the plan's renders, but for their numbers of samples.
[[nodiscard]] RenderSettings settings_of(const Scene& scene, const Plan& plan);

/// A plan that differs from another by one choice.
struct Candidate {
  Plan plan;
  std::vector<std::string> options;  ///< options_of the plan
  std::string kind;                  ///< of the choice; those of one kind exclude each other
  bool biased = false;               ///< another image is estimated
  std::function<void(Plan&)> make;   ///< the choice
};

/// All that could be chosen instead of what the plan has: each can change the image's error or its
/// time. What the scene has no use for is not among them, such as the choice among emitters where
/// one triangle emits. What a choice makes meaningless is as in the base. with_biased: also what
/// estimates another image.
[[nodiscard]] std::vector<Candidate> candidates_around(const Scene& scene, const Plan& plan,
                                                       const Plan& base, bool with_biased);

/// The base with the choices of several candidates around it, of different kinds, as far as they
/// still mean something together.
[[nodiscard]] Plan combine(const Scene& scene, const Plan& base, std::vector<Candidate> candidates);

/// A plan that estimates the same image with little noise, for references: no default of facet's is
/// taken on trust, and no choice that has a bias.
[[nodiscard]] Plan reference_plan(const Scene& scene, const Plan& plan);

/// Options of `facet render` that make the plan of what the scene says. Two plans whose options are
/// the same are one.
[[nodiscard]] std::vector<std::string> options_of(const Scene& scene, const Plan& plan);

/// What the plan does otherwise than the base, for people: "direct_ems, sobol, heuristic power";
/// "default" where nothing.
[[nodiscard]] std::string name_of(const Scene& scene, const Plan& plan, const Plan& base);

}  // namespace facet::tradeoff
