#pragma once
// What to sample among all that emits from a place (docs/reference/sampling.md, "Light tree").
#include <span>
#include <vector>

#include "reference/choice.h"
#include "reference/emitter/share.h"
#include "reference/real.h"
#include "scene/emitter/light_tree.h"

namespace facet::reference {

/// A point that light is wanted at.
template <typename Real>
struct Receiver {
  Vec3<Real> point{0};
  Vec3<Real> normal{0};  ///< unit, on the side that is lit; 0 where both are
};

/// The tree in use: leaves hold indices of what it was planted with.
class LightChooser {
 public:
  LightChooser() = default;
  /// weights: of the choice among the sources of a leaf.
  LightChooser(std::span<const LightSource> sources, std::span<const double> weights)
      : tree_(build_light_tree(sources)), leaves_(tree_.nodes.size()), leaf_of_(sources.size()) {
    for (std::size_t n = 0; n < tree_.nodes.size(); ++n) {
      const LightTree::Node& node = tree_.nodes[n];
      if (!node.is_leaf()) continue;
      std::vector<double> of_leaf;
      for (std::size_t i = 0; i < node.count; ++i) {
        const std::uint32_t source = tree_.order[node.first + i];
        of_leaf.push_back(weights[source]);
        leaf_of_[source] = {n, i};
      }
      leaves_[n] = Choice(of_leaf);
    }
  }

  [[nodiscard]] bool empty() const { return tree_.nodes.empty(); }
  [[nodiscard]] double energy() const { return tree_.energy; }

  /// A source, the probability of its choice (0 where nothing can light the point), and what is
  /// left of the word.
  template <typename Real>
  struct Outcome {
    std::size_t source = 0;
    Real probability = 0;
    std::uint32_t remainder = 0;
  };

  template <typename Real, typename Probe>
  [[nodiscard]] Outcome<Real> choose(const Receiver<Real>& at, std::uint32_t word,
                                     std::uint32_t fill, std::uint32_t fill_in_leaf,
                                     Probe& probe) const {
    std::size_t n = 0;
    Real probability = 1;
    while (!tree_.nodes[n].is_leaf()) {
      fill = next_fill(fill);
      const std::size_t first = tree_.nodes[n].first;
      const Split split = split_at(first, at, probe);
      if (split.is_dark) return {};
      const TwoWayChoice choice(split.first);
      const bool is_first = choice.is_first(word);
      word = choice.remainder(is_first, word, fill);
      const double p = is_first ? choice.probability() : 1 - choice.probability();
      probability *= static_cast<Real>(p);
      n = first + (is_first ? 0 : 1);
    }
    const Choice::Outcome in_leaf = leaves_[n].choose(word, fill_in_leaf);
    return {tree_.order[tree_.nodes[n].first + in_leaf.entry],
            probability * static_cast<Real>(leaves_[n].probability(in_leaf.entry)),
            in_leaf.remainder};
  }

  /// The probability with which `choose` comes to a source.
  template <typename Real, typename Probe>
  [[nodiscard]] Real probability(std::size_t source, const Receiver<Real>& at, Probe& probe) const {
    const auto [leaf, place] = leaf_of_[source];
    auto product = static_cast<Real>(leaves_[leaf].probability(place));
    for (std::size_t n = leaf; n != 0; n = tree_.nodes[n].parent) {
      const std::size_t first = tree_.nodes[tree_.nodes[n].parent].first;
      const Split split = split_at(first, at, probe);
      if (split.is_dark) return 0;
      const double p = TwoWayChoice(split.first).probability();
      product *= static_cast<Real>(n == first ? p : 1 - p);
    }
    return product;
  }

  /// How much the tree's sources may light a point, as a share of their energy.
  template <typename Real>
  [[nodiscard]] Real importance(const Receiver<Real>& at) const {
    return importance(tree_.nodes[0], at);
  }

 private:
  /// An angle in [0, pi].
  template <typename Real>
  struct Angle {
    Real cosine;
    Real sine;

    explicit Angle(Real c) : cosine(c), sine(std::sqrt(std::max(1 - c * c, Real(0)))) {}
    Angle(Real c, Real s) : cosine(c), sine(s) {}

    /// This one less another, but not below 0.
    [[nodiscard]] Angle less(const Angle& b) const {
      if (cosine >= b.cosine) return {1, 0};
      return {cosine * b.cosine + sine * b.sine, sine * b.cosine - cosine * b.sine};
    }
  };

  template <typename Real>
  [[nodiscard]] static Real importance(const LightTree::Node& node, const Receiver<Real>& at) {
    constexpr auto slack = static_cast<Real>(1e-4);
    const Vec3<Real> way = Vec3<Real>(node.center) - at.point;
    const Real d2 = glm::dot(way, way);
    const Real r2 = static_cast<Real>(node.radius) * static_cast<Real>(node.radius);
    const bool inside = d2 <= r2;
    const Angle<Real> filled =
        inside ? Angle<Real>(-1, 0) : Angle<Real>(std::sqrt(1 - r2 / d2), std::sqrt(r2 / d2));
    const Vec3<Real> w = d2 > 0 ? way / std::sqrt(d2) : Vec3<Real>(0);
    const Angle<Real> to_axis(-glm::dot(Vec3<Real>(node.axis), w));
    const Angle<Real> cone(static_cast<Real>(node.cosine));
    Real cosines = std::max(to_axis.less(cone).less(filled).cosine + slack, Real(0));
    if (at.normal != Vec3<Real>(0)) {
      const Angle<Real> to_normal(glm::dot(at.normal, w));
      cosines *= std::max(to_normal.less(filled).cosine + slack, Real(0));
    } else {
      cosines *= 1 + slack;
    }
    const Real nearest = std::max(inside ? r2 : d2, static_cast<Real>(1e-37));
    return static_cast<Real>(node.energy) * cosines / nearest;
  }

  /// How a choice between siblings is made.
  struct Split {
    double first = 0;  ///< probability of the first
    bool is_dark = false;
  };

  template <typename Real, typename Probe>
  [[nodiscard]] Split split_at(std::size_t first, const Receiver<Real>& at, Probe& probe) const {
    const Real a = probe.nudged(importance(tree_.nodes[first], at));
    const Real b = probe.nudged(importance(tree_.nodes[first + 1], at));
    if (!(a + b > 0)) return {0, true};
    return {share_of_first(a, b, DecisionKind::light, first, probe)};
  }

  LightTree tree_;
  std::vector<Choice> leaves_;  ///< by node
  struct Place {
    std::size_t leaf = 0;
    std::size_t place = 0;
  };
  std::vector<Place> leaf_of_;  ///< of each source
};

}  // namespace facet::reference
