#include "parity/explain.h"

#include <fmt/format.h>

#include "reference/tracer.h"

namespace facet::parity {

using reference::Decision;
using reference::decision_name;
using reference::Tracer;
using reference::Triangle;
using reference::Watch;

namespace {

constexpr std::uint32_t perturbation_count = 4;
/// A decision that four perturbed runs did not move is still at rounding level within this margin:
/// 4 ulps of the numbers compared.
constexpr double least_margin = 4 * 1.1920929e-7;
/// Decisions turned one after the other at most, and attempts at most.
constexpr int step_limit = 4;
constexpr int attempt_limit = 300;

struct Run {
  Vec3<float> radiance{0};
  std::map<DecisionKey, Decision> decisions;
};

class Explainer {
 public:
  Explainer(const World<float>& world, int x, int y, const SampleId& id, const Vec3<float>& kernels,
            const Tolerance& tolerance)
      : world_(world), x_(x), y_(y), id_(id), kernels_(kernels), tolerance_(tolerance) {}

  Explanation explain(bool turn) {
    Explanation result;
    result.agrees = try_forced(result);
    if (!decisions_.empty()) result.nearest = decisions_.front();
    const std::vector<TurnedDecision> first = decisions_;
    const Vec3<float> untouched = reference_;
    // Few decisions before many.
    for (int steps = 1; turn && steps <= step_limit && !result.explained(); ++steps) {
      decisions_ = first;
      reference_ = untouched;
      (void)search(steps, result);
    }
    return result;
  }

 private:
  [[nodiscard]] Run run(std::uint32_t perturbation, const ForcedOutcomes& forced) const {
    Watch watch(perturbation, forced);
    Tracer<float, Watch> tracer(world_, id_, watch);
    const Vec3<float> radiance = tracer.radiance(x_, y_);
    return {radiance, watch.decisions()};
  }

  /// Runs the sample, and perturbed, with what is forced now; whether it then is the kernels'.
  /// Keeps the decisions, ranked, in `decisions_`.
  bool try_forced(Explanation& result) {
    ++attempts_;
    const Run base = run(0, forced_);
    reference_ = base.radiance;
    // Perturbed runs are held to the same decisions: what they tell is how the value moves along
    // these. Only where rounding is so amplified that a ray meets other triangles altogether do
    // they part.
    ForcedOutcomes same_branches = forced_;
    for (const auto& [key, decision] : base.decisions) same_branches[key] = decision.outcome;
    std::vector<Run> perturbed;
    for (std::uint32_t p = 1; p <= perturbation_count; ++p)
      perturbed.push_back(run(p, same_branches));
    result.spread = Vec3<double>(0);
    for (const Run& r : perturbed) {
      result.spread =
          glm::max(result.spread, glm::abs(Vec3<double>(r.radiance) - Vec3<double>(base.radiance)));
    }
    rank_decisions(base, perturbed);
    return agrees(kernels_, base.radiance, tolerance_.spread_factor * result.spread,
                  tolerance_.relative);
  }

  /// Sorts the decisions, those decided by least, measured by their own rounding, first.
  void rank_decisions(const Run& base, const std::vector<Run>& perturbed) {
    decisions_.clear();
    for (const auto& [key, decision] : base.decisions) {
      if (forced_.contains(key)) continue;
      double spread = 0;
      for (const Run& r : perturbed) {
        const auto same = r.decisions.find(key);
        if (same != r.decisions.end())
          spread = std::max(spread, std::abs(same->second.margin - decision.margin));
      }
      decisions_.push_back({key, !decision.outcome, decision.margin, spread});
    }
    std::stable_sort(
        decisions_.begin(), decisions_.end(),
        [&](const TurnedDecision& a, const TurnedDecision& b) { return ratio(a) < ratio(b); });
  }

  /// A decision's margin in units of what rounding can do to it; up to 1 it is at rounding level.
  [[nodiscard]] double ratio(const TurnedDecision& t) const {
    // An exact 0 that no rounding moves is the same 0 for every renderer; only among equal
    // distances the order is anybody's.
    if (t.margin == 0 && t.spread == 0 && t.key.kind != DecisionKind::order)
      return std::numeric_limits<double>::infinity();
    return std::abs(t.margin) / std::max(tolerance_.spread_factor * t.spread, least_margin);
  }

  /// Turns decisions at rounding level, a number of them one after the other: a turned one may
  /// bring others.
  bool search(int steps, Explanation& result) {
    const std::vector<TurnedDecision> candidates = decisions_;
    const Vec3<float> before = reference_;
    const std::size_t turned_before = result.turned.size();
    for (const TurnedDecision& candidate : candidates) {
      if (!(ratio(candidate) <= 1) || attempts_ >= attempt_limit) return false;
      turn(candidate, result);
      if (candidate.key.kind == DecisionKind::edge) turn_beyond(candidate, candidates, result);
      if (try_forced(result)) return true;
      // A decision that changes nothing leads nowhere; but behind a triangle may lie another.
      const bool leads_on = reference_ != before || candidate.key.kind == DecisionKind::edge;
      if (steps > 1 && leads_on && search(steps - 1, result)) return true;
      for (std::size_t i = turned_before; i < result.turned.size(); ++i)
        forced_.erase(result.turned[i].key);
      result.turned.resize(turned_before);
    }
    return false;
  }

  void turn(const TurnedDecision& decision, Explanation& result) {
    forced_[decision.key] = decision.outcome;
    result.turned.push_back(decision);
  }

  /// A ray that crosses an edge leaves one triangle and enters its neighbour: turns the nearest
  /// such decision of the same ray.
  void turn_beyond(const TurnedDecision& edge, const std::vector<TurnedDecision>& decisions,
                   Explanation& result) {
    for (const TurnedDecision& other : decisions) {
      if (ratio(other) > 1) return;
      if (other.key.kind != DecisionKind::edge || other.key.ray != edge.key.ray) continue;
      if (other.key.item == edge.key.item || other.outcome == edge.outcome) continue;
      turn(other, result);
      return;
    }
  }

  const World<float>& world_;
  int x_;
  int y_;
  SampleId id_;
  Vec3<float> kernels_;
  Tolerance tolerance_;
  ForcedOutcomes forced_;
  std::vector<TurnedDecision> decisions_;
  Vec3<float> reference_{0};  ///< of the last attempt
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
    const double allowed = relative * std::abs(f) + slack[c] + std::numeric_limits<float>::min();
    if (!(std::abs(g - f) <= allowed)) return false;
  }
  return true;
}

Explanation explain(const World<float>& world, int x, int y, const SampleId& id,
                    const Vec3<float>& kernels, const Tolerance& tolerance, bool turn) {
  return Explainer(world, x, y, id, kernels, tolerance).explain(turn);
}

std::string describe(const World<float>& world, const TurnedDecision& t) {
  const std::uint32_t k = t.key.ray / 2 + 1;
  const bool shadow = t.key.ray % 2 == 1;
  std::string item = item_text(world, t.key);
  if (!item.empty()) item = " of " + item;
  const bool every = world.integrator.type.every_emitter;
  const std::string emitter =
      every ? fmt::format("sample of emitter {}", t.key.emitter) : "emitter sample";
  const std::string place =
      shadow ? fmt::format("the {} of interaction", emitter) : "the ray to interaction";
  return fmt::format("{}{}, at {} {}: margin {:.2g}, spread {:.2g}", decision_name(t.key.kind),
                     item, place, k, t.margin, t.spread);
}

}  // namespace facet::parity
