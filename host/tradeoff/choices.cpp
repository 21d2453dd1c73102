#include "tradeoff/choices.h"

#include <algorithm>
#include <set>

#include "core/words.h"
#include "image/record.h"

namespace facet::tradeoff {

namespace {

/// Maximum depths, and numbers of candidates of an emitter sample, worth a look.
constexpr std::array depths{2, 3, 5, 8};
constexpr std::array candidate_counts{1, 4};

template <typename Condition>
bool some_rough_bsdf(const Scene& scene, const Condition& condition) {
  return std::ranges::any_of(scene.bsdfs, [&](const Bsdf& bsdf) {
    return std::visit(
        [&](const auto& b) {
          if constexpr (requires { b.options; }) return condition(b.options);
          return false;
        },
        bsdf);
  });
}

/// Triangles that emit, two that are alone counting as one, and point lights: what a light tree
/// chooses among.
std::size_t emitting_pieces(const Scene& scene) {
  std::size_t count = 0;
  for (const Emitter& emitter : scene.emitters) {
    const auto* area = std::get_if<AreaEmitter>(&emitter);
    const std::size_t triangles =
        area != nullptr ? scene.meshes[area->mesh].position_indices.size() : 0;
    count += triangles == 2 || std::holds_alternative<PointLight>(emitter) ? 1 : triangles;
  }
  return count;
}

/// Whether some triangle of an emitter is large enough to be sampled by solid angle from half the
/// scene's size away.
bool has_large_piece(const Scene& scene) {
  const double reach = glm::length(dvec3(scene.bounds().extent())) / 2;
  return std::ranges::any_of(scene.emitters, [&](const Emitter& emitter) {
    const auto* area = std::get_if<AreaEmitter>(&emitter);
    if (area == nullptr) return false;
    const Mesh& mesh = scene.meshes[area->mesh];
    for (std::size_t i = 0; i < mesh.position_indices.size(); ++i) {
      if (triangle_area(mesh, i) >= shared::SMALLEST_SEEN * reach * reach) return true;
    }
    return false;
  });
}

/// How an integrator estimates direct light.
auto means_of(const IntegratorType& t) {
  return std::tuple(t.emitter_sampling, t.every_emitter, t.material_sampling);
}

/// Whether two names are of one integrator.
bool is_same(const IntegratorType& a, const IntegratorType& b) {
  return a.kernel == b.kernel && a.interactions == b.interactions && means_of(a) == means_of(b);
}

/// Whether two integrators estimate the same, by different means.
bool are_alternatives(const IntegratorType& a, const IntegratorType& b) {
  const auto estimates_light = [](const IntegratorType& t) {
    return t.emitter_sampling || t.material_sampling;
  };
  // Sampling every emitter, paths of several interactions go on at delta lobes alone.
  const auto goes_on = [](const IntegratorType& t) {
    return !t.every_emitter || t.interactions == 1;
  };
  return estimates_light(a) && estimates_light(b) && goes_on(a) && goes_on(b) &&
         a.interactions == b.interactions && means_of(a) != means_of(b);
}

/// One thing decided otherwise.
struct Choice {
  std::string kind;
  std::function<void(Plan&)> make;
};

/// Lists the choices that a resolved plan leaves.
class ChoiceList {
 public:
  ChoiceList(const Scene& scene, const Plan& plan)
      : scene_(scene), plan_(plan), now_(settings_of(scene, plan)) {}

  std::vector<Choice> unbiased() {
    add_integrators();
    for (const Sampler sampler : {Sampler::independent, Sampler::sobol}) {
      // What zsobol does otherwise than sobol, no error of pixels tells.
      if (is_independent(sampler) != is_independent(now_.sampler))
        add("sampler", [sampler](Plan& p) { p.request.sampler = name_of(sampler); });
    }
    add_sampling();
    add_emitter_selection();
    add_area_sampling();
    add_environment_sampling();
    add_emitter_candidates();
    const IntegratorType& type = now_.integrator.type;
    if (type.emitter_sampling && type.material_sampling) {
      add_words("heuristic", heuristic_words, now_.integrator.heuristic,
                [](Plan& p, Heuristic value) { p.request.heuristic = value; });
    }
    const bool adaptive = !now_.adaptive;
    add("adaptive", [adaptive](Plan& p) { p.request.adaptive = adaptive; });
    return std::move(list_);
  }

  std::vector<Choice> biased() {
    const int limit = now_.integrator.interaction_limit();
    for (const int depth : depths) {
      if (now_.integrator.type.interactions < 0 && now_.integrator.needs_emitters() &&
          (limit < 0 || depth < limit))
        add("max-depth", [depth](Plan& p) { p.request.max_depth = depth; });
    }
    const bool inexact = some_rough_bsdf(scene_, [](const bsdf::MicrofacetOptions& o) {
      return o.distribution == bsdf::Distribution::beckmann && o.masking != Masking::exact;
    });
    if (inexact && now_.masking != Masking::exact)
      add("masking", [](Plan& p) { p.request.masking = Masking::exact; });
    if (!plan_.reference) {
      for (const auto& word : precision_words)
        add("precision", [value = word.value](Plan& p) { p.reference = value; });
    }
    return std::move(list_);
  }

 private:
  void add(std::string kind, std::function<void(Plan&)> make) {
    list_.push_back({std::move(kind), std::move(make)});
  }

  template <typename Words, typename Value, typename Set>
  void add_words(const std::string& kind, const Words& words, const Value& now, const Set& set) {
    for (const auto& word : words) {
      if (word.value == now) continue;
      add(kind, [set, value = word.value](Plan& p) { set(p, value); });
    }
  }

  void add_integrators() {
    std::vector<IntegratorType> known;
    for (const IntegratorType& type : integrator_types()) {
      const bool is_another_name = std::ranges::any_of(
          known, [&](const IntegratorType& k) { return !are_alternatives(k, type); });
      if (!are_alternatives(now_.integrator.type, type) || is_another_name) continue;
      if (type.every_emitter && scene_.emitters.size() < 2) continue;
      known.push_back(type);
      add("integrator", [name = type.name](Plan& p) { p.request.integrator = name; });
    }
  }

  void add_sampling() {
    const IntegratorType& type = now_.integrator.type;
    const bool is_used =
        type.material_sampling || (type.emitter_sampling && type.interactions != 1);
    if (!is_used || !some_rough_bsdf(scene_, [](const auto&) { return true; })) return;
    const std::array of_kernels{lobe_sampling_words[0], lobe_sampling_words[1]};
    add_words("sampling", of_kernels, now_.sampling,
              [](Plan& p, LobeSampling value) { p.request.sampling = value; });
  }

  void add_emitter_selection() {
    const IntegratorType& type = now_.integrator.type;
    if (!type.emitter_sampling || type.every_emitter) return;
    // What a word comes to: power tells emitters apart, not the triangles of one, and without a
    // tree to walk each emitter is as good.
    const auto meant = [&](EmitterSelection selection) {
      if (selection == EmitterSelection::power && scene_.emitters.size() < 2)
        return EmitterSelection::uniform;
      if (selection == EmitterSelection::contribution && emitting_pieces(scene_) < 2)
        return EmitterSelection::uniform;
      return selection;
    };
    std::set<EmitterSelection> listed{meant(now_.integrator.emitter_selection)};
    for (const auto& word : emitter_selection_words) {
      if (!listed.insert(meant(word.value)).second) continue;
      add("emitter-selection",
          [value = word.value](Plan& p) { p.request.emitter_selection = value; });
    }
  }

  void add_area_sampling() {
    if (!now_.integrator.type.emitter_sampling || !has_large_piece(scene_)) return;
    add_words("area-sampling", area_sampling_words, now_.integrator.area_sampling,
              [](Plan& p, AreaSampling value) { p.request.area_sampling = value; });
  }

  void add_environment_sampling() {
    const IntegratorType& type = now_.integrator.type;
    if (!type.emitter_sampling || !type.material_sampling || scene_.environment() == none) return;
    // What is the same everywhere has nothing above its mean.
    const auto& sky = std::get<EnvironmentEmitter>(scene_.emitters[scene_.environment()]);
    if (sky.texels.size() == 1) return;
    add_words("environment-sampling", environment_sampling_words,
              now_.integrator.environment_sampling,
              [](Plan& p, EnvironmentSampling value) { p.request.environment_sampling = value; });
  }

  void add_emitter_candidates() {
    const IntegratorType& type = now_.integrator.type;
    const bool has_one_point = emitting_pieces(scene_) == 1 && scene_.environment() == none &&
                               std::holds_alternative<PointLight>(scene_.emitters.front());
    if (!type.emitter_sampling || type.every_emitter || has_one_point) return;
    for (const int count : candidate_counts) {
      if (count != now_.integrator.emitter_candidates)
        add("emitter-candidates", [count](Plan& p) { p.request.emitter_candidates = count; });
    }
  }

  const Scene& scene_;
  const Plan& plan_;
  RenderSettings now_;
  std::vector<Choice> list_;
};

/// Kinds of the unbiased choices that a plan leaves.
std::set<std::string> kinds_of(const Scene& scene, const Plan& plan) {
  std::set<std::string> kinds;
  for (const Choice& choice : ChoiceList(scene, plan).unbiased()) kinds.insert(choice.kind);
  return kinds;
}

/// What a plan has no use for becomes as in the base, and of two names of an integrator it has the
/// base's.
void clear_meaningless(const Scene& scene, Plan& plan, const Plan& base) {
  const IntegratorType type = settings_of(scene, plan).integrator.type;
  const IntegratorType base_type = settings_of(scene, base).integrator.type;
  if (is_same(type, base_type)) plan.request.integrator = base.request.integrator;
  const std::set<std::string> kinds = kinds_of(scene, plan);
  const auto reset = [&](const char* kind, auto RenderRequest::*choice) {
    if (!kinds.contains(kind)) plan.request.*choice = base.request.*choice;
  };
  reset("heuristic", &RenderRequest::heuristic);
  reset("emitter-selection", &RenderRequest::emitter_selection);
  reset("area-sampling", &RenderRequest::area_sampling);
  reset("environment-sampling", &RenderRequest::environment_sampling);
  reset("emitter-candidates", &RenderRequest::emitter_candidates);
  reset("sampling", &RenderRequest::sampling);
}

}  // namespace

std::vector<Candidate> candidates_around(const Scene& scene, const Plan& plan, const Plan& base,
                                         bool with_biased) {
  std::vector<Candidate> candidates;
  const auto add = [&](const std::vector<Choice>& choices, bool biased) {
    for (const Choice& choice : choices) {
      Plan changed = plan;
      choice.make(changed);
      clear_meaningless(scene, changed, base);
      candidates.push_back({changed, options_of(scene, changed), choice.kind, biased, choice.make});
    }
  };
  add(ChoiceList(scene, plan).unbiased(), false);
  if (with_biased) add(ChoiceList(scene, plan).biased(), true);
  return candidates;
}

Plan combine(const Scene& scene, const Plan& base, std::vector<Candidate> candidates) {
  // What others mean depends on the integrator.
  std::stable_partition(candidates.begin(), candidates.end(),
                        [](const Candidate& c) { return c.kind == "integrator"; });
  Plan plan = base;
  for (const Candidate& candidate : candidates) {
    if (kinds_of(scene, plan).contains(candidate.kind)) candidate.make(plan);
    clear_meaningless(scene, plan, base);
  }
  return plan;
}

Plan reference_plan(const Scene& scene, const Plan& plan) {
  Plan best = plan;
  RenderRequest& r = best.request;
  r.sampler = name_of(Sampler::sobol);
  r.sampling = LobeSampling::visible;
  r.emitter_selection = EmitterSelection::contribution;
  r.heuristic = Heuristic::power;
  r.adaptive = false;
  best.reference.reset();
  const IntegratorType now = settings_of(scene, plan).integrator.type;
  for (const IntegratorType& type : integrator_types()) {
    if (are_alternatives(now, type) && type.emitter_sampling && type.material_sampling)
      r.integrator = type.name;
  }
  return best;
}

}  // namespace facet::tradeoff
