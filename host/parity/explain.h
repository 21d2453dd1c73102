#pragma once
// Why a sample of the kernels is not the reference's: rounding that an ill-conditioned sample
// amplifies, or a decision that fell the other way, or a fault.
#include <optional>

#include "reference/world.h"

namespace facet::parity {

using reference::DecisionKey;
using reference::DecisionKind;
using reference::ForcedOutcomes;
using reference::SampleId;
using reference::Vec3;
using reference::World;

/// The rule of agreement: |G - F| <= relative |F| + spread_factor * s in every channel, s being the
/// spread of F over four perturbed runs that are held to F's decisions.
struct Tolerance {
  double relative = 1e-5;
  double spread_factor = 8;
};

/// Of a device. Vulkan allows division 2.5 ulp and square roots about 3, where a CPU's drivers
/// round correctly: elsewhere each perturbation by one ulp stands for three.
[[nodiscard]] inline Tolerance tolerance_on(bool cpu) {
  Tolerance tolerance;
  if (!cpu) tolerance.spread_factor *= 3;
  return tolerance;
}

/// A decision that was turned.
struct TurnedDecision {
  DecisionKey key;
  bool outcome = false;  ///< the kernels' one
  double margin = 0;     ///< the reference's, signed, relative
  double spread = 0;     ///< of the margin over the perturbed runs
};

struct Explanation {
  /// Holds without any decision turned.
  bool agrees = false;
  /// Otherwise: the decisions that, turned, reproduce the kernels' sample; empty where none do.
  std::vector<TurnedDecision> turned;
  /// The decision that was decided by least, measured by its spread, whether that is little enough
  /// or not.
  std::optional<TurnedDecision> nearest;
  /// Spread of the reference's value, per channel.
  Vec3<double> spread{0};

  [[nodiscard]] bool explained() const { return agrees || !turned.empty(); }
};

/// Explains one sample in float. kernels: its radiance as the kernels have it. turn: whether
/// decisions are turned; else only the spread is looked at.
[[nodiscard]] Explanation explain(const World<float>& world, int x, int y, const SampleId& id,
                                  const Vec3<float>& kernels, const Tolerance& tolerance,
                                  bool turn = true);

/// "the edge of triangle 12 of box.obj, at the ray to interaction 2: margin 3e-08, spread 1e-07"
[[nodiscard]] std::string describe(const World<float>& world, const TurnedDecision& turned);

/// |G - F| <= relative |F| + slack + 1.2e-38 in all channels (below, floats lose their digits, and
/// kernels may flush them); not finite: alike.
[[nodiscard]] bool agrees(const Vec3<float>& kernels, const Vec3<float>& reference,
                          const Vec3<double>& slack, double relative);

}  // namespace facet::parity
