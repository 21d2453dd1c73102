// Plans: the settings that they come to, their options and names.
#include <fmt/format.h>

#include "convergence/sampling_plan.h"
#include "image/record.h"
#include "image/rerun.h"
#include "scene/scene.h"
#include "tradeoff/choices.h"

namespace facet::tradeoff {

namespace {

/// What a plan comes to, without samples and seed, which every render has others of.
RenderRecord record_for(const Scene& scene, const Plan& plan) {
  RenderRecord record = record_of(settings_of(scene, plan));
  record.backend = plan.reference ? "reference" : "vulkan";
  record.precision = plan.reference.value_or(Precision::float_);
  record.samples = {};
  record.planned.reset();
  record.seed = 0;
  return record;
}

}  // namespace

RenderSettings settings_of(const Scene& scene, const Plan& plan) {
  RenderRequest request = plan.request;
  // What a scene asks for may be too few for adaptive sampling.
  request.samples = least_adaptive_samples;
  return resolve(scene, request);
}

std::vector<std::string> options_of(const Scene& scene, const Plan& plan) {
  // What a depth means is told by the integrator, and a scene may leave that to whoever renders it.
  Plan said;
  said.request.integrator = plan.request.integrator;
  RenderRecord own = record_for(scene, said);
  own.integrator = scene.integrator.type.name;
  return options_between(own, record_for(scene, plan));
}

std::string name_of(const Scene& scene, const Plan& plan, const Plan& base) {
  const std::vector<std::string> options =
      options_between(record_for(scene, base), record_for(scene, plan));
  std::vector<std::string> names;
  for (std::size_t i = 0; i < options.size(); ++i) {
    const bool has_value = i + 1 < options.size() && !options[i + 1].starts_with("--");
    const std::string value = has_value ? options[i + 1] : "";
    // These two are known by their values.
    const bool by_value = options[i] == "--integrator" || options[i] == "--sampler";
    const std::string option = options[i].substr(2);
    names.push_back(by_value ? value : has_value ? fmt::format("{} {}", option, value) : option);
    if (has_value) ++i;
  }
  if (base.request.adaptive && !plan.request.adaptive) names.emplace_back("not adaptive");
  return names.empty() ? "default" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace facet::tradeoff
