#include "reference/explain.h"

#include <fmt/format.h>

#include "reference/tracer.h"

namespace facet::reference {

namespace {

constexpr std::uint32_t perturbation_count = 4;
/// A decision that four perturbed runs did not move is still at rounding level within this margin: 4 ulps of
/// the numbers compared.
constexpr double least_margin = 4 * 1.1920929e-7;
/// Decisions turned together at most, and attempts at most.
constexpr std::size_t turned_limit = 3;
constexpr int attempt_limit = 100;

struct Run {
  Vec3<float> radiance{0};
  std::map<DecisionKey, Decision> decisions;
  std::uint64_t branches = 0;
};

class Explainer {
 public:
  Explainer(const World<float>& world, int x, int y, const SampleId& id, const Vec3<float>& kernels,
            const Tolerance& tolerance)
      : world_(world), x_(x), y_(y), id_(id), kernels_(kernels), tolerance_(tolerance) {}

  Explanation explain() {
    Explanation result;
    result.agrees = try_forced(result);
    if (!result.agrees) (void)search(result);
    return result;
  }

 private:
  [[nodiscard]] Run run(std::uint32_t perturbation) const {
    Watch watch(perturbation, forced_);
    Tracer<float, Watch> tracer(world_, id_, watch);
    const Vec3<float> radiance = tracer.radiance(x_, y_);
    return {radiance, watch.decisions(), watch.branches()};
  }

  /// Runs the sample, and perturbed, with what is forced now; whether it then is the kernels'. Keeps the
  /// decisions that rounding could turn in `critical_`.
  bool try_forced(Explanation& result) {
    ++attempts_;
    const Run base = run(0);
    std::vector<Run> perturbed;
    for (std::uint32_t p = 1; p <= perturbation_count; ++p) perturbed.push_back(run(p));
    result.spread = Vec3<double>(0);
    for (const Run& r : perturbed) {
      if (r.branches != base.branches) continue;
      result.spread =
          glm::max(result.spread, glm::abs(Vec3<double>(r.radiance) - Vec3<double>(base.radiance)));
    }
    find_critical(base, perturbed);
    return agrees(kernels_, base.radiance, tolerance_.spread_factor * result.spread, tolerance_.relative);
  }

  void find_critical(const Run& base, const std::vector<Run>& perturbed) {
    critical_.clear();
    for (const auto& [key, decision] : base.decisions) {
      if (forced_.contains(key)) continue;
      double spread = 0;
      for (const Run& r : perturbed) {
        const auto same = r.decisions.find(key);
        if (same != r.decisions.end())
          spread = std::max(spread, std::abs(same->second.margin - decision.margin));
      }
      const double reach = std::max(tolerance_.spread_factor * spread, least_margin);
      if (!(std::abs(decision.margin) > reach))
        critical_.push_back({key, !decision.outcome, decision.margin, spread});
    }
    // What was decided by least, measured by its own rounding, is tried first.
    const auto closeness = [](const TurnedDecision& t) {
      return std::abs(t.margin) / std::max(t.spread, least_margin);
    };
    std::sort(critical_.begin(), critical_.end(),
              [&](const TurnedDecision& a, const TurnedDecision& b) { return closeness(a) < closeness(b); });
  }

  /// Turns one more of the critical decisions, depth first: a turned one may bring others.
  bool search(Explanation& result) {
    if (result.turned.size() == turned_limit) return false;
    const std::vector<TurnedDecision> candidates = critical_;
    for (const TurnedDecision& candidate : candidates) {
      if (attempts_ >= attempt_limit) return false;
      forced_[candidate.key] = candidate.outcome;
      result.turned.push_back(candidate);
      if (try_forced(result) || search(result)) return true;
      result.turned.pop_back();
      forced_.erase(candidate.key);
    }
    return false;
  }

  const World<float>& world_;
  int x_;
  int y_;
  SampleId id_;
  Vec3<float> kernels_;
  Tolerance tolerance_;
  ForcedOutcomes forced_;
  std::vector<TurnedDecision> critical_;
  int attempts_ = 0;
};

/// What the item of a decision names.
std::string item_text(const World<float>& world, const DecisionKey& key) {
  const auto triangle = [&](std::uint64_t place) {
    const Triangle<float>& t = world.geometry.triangles.at(static_cast<std::size_t>(place));
    return fmt::format("triangle {} of {}", t.index, world.scene.meshes[t.mesh].name);
  };
  switch (key.kind) {
    case DecisionKind::edge:
      return triangle(key.item);
    case DecisionKind::range:
      return triangle(key.item / 2);
    case DecisionKind::order:
      return fmt::format("{} and {}", triangle(key.item >> 32U), triangle(key.item & 0xffffffffU));
    default:
      return "";
  }
}

}  // namespace

bool agrees(const Vec3<float>& kernels, const Vec3<float>& reference, const Vec3<double>& slack,
            double relative) {
  for (int c = 0; c < 3; ++c) {
    const auto g = static_cast<double>(kernels[c]);
    const auto f = static_cast<double>(reference[c]);
    if (!std::isfinite(g) && !std::isfinite(f)) continue;
    if (!(std::abs(g - f) <= relative * std::abs(f) + slack[c])) return false;
  }
  return true;
}

Explanation explain(const World<float>& world, int x, int y, const SampleId& id, const Vec3<float>& kernels,
                    const Tolerance& tolerance) {
  return Explainer(world, x, y, id, kernels, tolerance).explain();
}

std::string describe(const World<float>& world, const TurnedDecision& t) {
  const std::uint32_t k = t.key.ray / 2 + 1;
  const bool shadow = t.key.ray % 2 == 1;
  std::string item = item_text(world, t.key);
  if (!item.empty()) item = " of " + item;
  return fmt::format("{}{}, at {} {}: margin {:.2g}, spread {:.2g}", decision_name(t.key.kind), item,
                     shadow ? "the emitter sample of interaction" : "the ray to interaction", k, t.margin,
                     t.spread);
}

}  // namespace facet::reference
