#pragma once
// What watches a sample while it is computed. Images are rendered unwatched; `facet parity` asks
// which decisions a sample took, by how much they were decided, and what becomes of it when one
// falls the other way.
#include <algorithm>
#include <compare>
#include <cstdint>
#include <map>
#include <vector>

#include "reference/real.h"

namespace facet::reference {

/// Every kind of discrete decision that rounding can turn. The margin that goes with a decision is
/// signed and relative: 1 is the size of the numbers that were compared.
enum class DecisionKind : std::uint8_t {
  edge,         ///< is the ray inside a triangle's edges: smallest barycentric weight
  order,        ///< which of two triangles is nearer
  range,        ///< does a hit lie within the ray's range
  frame,        ///< which half of the sphere does the shading frame belong to: n.z
  horizon,      ///< is a direction above the shaded side, or above a microfacet: its z
  emission,     ///< does an emitter show its bright side: ns.d
  offset,       ///< to which side of its surface does a ray leave: d.ng
  lobe,         ///< which lobe is sampled: u - p
  masking,      ///< is G1 1: b - 1.6
  tail,         ///< is D zero: tan^2/alpha^2 - 87
  reflectance,  ///< is reflection total
  cell,  ///< in which cell of the environment's density or of a checker lies a direction or a point
  texel,              ///< between which texels of an image: its slope changes there
  roulette,           ///< does the path go on: u - q
  light,              ///< how is the probability of one of two lights rounded
  solid_angle,        ///< is a piece of an emitter sampled by the solid angle it fills
  solid_angle_share,  ///< how is the probability of one of its two triangles rounded
  candidate,          ///< which candidate of an emitter sample is taken: its share of the sum
};

[[nodiscard]] const char* decision_name(DecisionKind kind);

/// One decision of a sample. ray: 2 (k - 1) for the path's ray to interaction k and what is decided
/// there, one more for that interaction's shadow ray and emitter sample. emitter: where every
/// emitter is sampled; or a candidate of an emitter sample. item: which of several, for instance
/// the triangle.
struct DecisionKey {
  DecisionKind kind{};
  std::uint32_t ray = 0;
  std::uint32_t emitter = 0;
  std::uint64_t item = 0;

  auto operator<=>(const DecisionKey&) const = default;
};

/// Parts of the renderer that a sample can need: what a fault in one of them has touched.
enum class Part : std::uint8_t {
  mesh,            ///< a hit on mesh number i
  vertex_normals,  ///< shading with interpolated normals
  texture,         ///< value of texture number i
  bsdf_eval,       ///< value of the BSDF of type i, for an emitter sample
  bsdf_sample,     ///< a direction sampled by the BSDF of type i
  bsdf_pdf,        ///< density of the BSDF of type i, for a MIS weight
  emitter_sample,  ///< a sample of emitter i
  emission_found,  ///< emission of emitter i found by a BSDF sample, with its density
  emission_seen,   ///< emission of emitter i seen by the camera
  roulette,        ///< Russian roulette was played
  blocked_shadow_ray,
};

struct Feature {
  Part part{};
  std::uint32_t index = 0;

  auto operator<=>(const Feature&) const = default;
};

struct Decision {
  bool outcome = false;
  double margin = 0;
};

/// Comparisons that are decisions: each tells the probe its outcome and its margin, and returns
/// what the probe says. item: which of several decisions of that kind at one place.
template <typename Probe>
class Decisions {
 public:
  /// Whether value > 0.
  template <typename Real>
  bool positive(DecisionKind kind, Real value, std::uint64_t item = 0) {
    return probe().decide(kind, item, value > 0, static_cast<double>(value));
  }
  /// Whether value < 0.
  template <typename Real>
  bool negative(DecisionKind kind, Real value, std::uint64_t item = 0) {
    return probe().decide(kind, item, value < 0, static_cast<double>(value));
  }
  /// Whether value < bound, for numbers of the size of 1.
  template <typename Real>
  bool below(DecisionKind kind, Real value, Real bound, std::uint64_t item = 0) {
    return probe().decide(kind, item, value < bound, static_cast<double>(bound - value));
  }
  /// Whether value is not below a bound above 0, relative to which the margin counts.
  template <typename Real>
  bool reaches(DecisionKind kind, Real value, double bound, std::uint64_t item = 0) {
    const bool outcome = !(value < static_cast<Real>(bound));
    return probe().decide(kind, item, outcome, static_cast<double>(value) / bound - 1);
  }

 private:
  Probe& probe() { return static_cast<Probe&>(*this); }
};

/// Watches nothing and costs nothing.
struct Unwatched : Decisions<Unwatched> {
  static constexpr bool watches = false;

  void at_ray(std::uint32_t /*ray*/, std::size_t /*emitter*/ = 0) {}
  void found(std::uint32_t /*triangle*/) {}
  void uses(Part /*part*/, std::size_t /*index*/) {}
  bool decide(DecisionKind /*kind*/, std::uint64_t /*item*/, bool outcome, double /*margin*/) {
    return outcome;
  }
  template <typename Value>
  Value nudged(const Value& v) {
    return v;
  }
};

/// Tells whether two runs took the same branches, by a hash of all outcomes, and what they used.
struct BranchHash : Decisions<BranchHash> {
  static constexpr bool watches = false;

  std::uint64_t hash = 0x9e3779b97f4a7c15ULL;
  std::vector<Feature> features;

  void uses(Part part, std::size_t index) {
    const Feature feature{part, static_cast<std::uint32_t>(index)};
    if (std::find(features.begin(), features.end(), feature) == features.end())
      features.push_back(feature);
  }
  void at_ray(std::uint32_t /*ray*/, std::size_t /*emitter*/ = 0) {}
  template <typename Value>
  Value nudged(const Value& v) {
    return v;
  }
  void mix(std::uint64_t word) {
    hash = (hash ^ word) * 0xff51afd7ed558ccdULL;
    hash ^= hash >> 32U;
  }
  void found(std::uint32_t triangle) { mix(triangle); }
  bool decide(DecisionKind kind, std::uint64_t item, bool outcome, double /*margin*/) {
    mix((static_cast<std::uint64_t>(kind) << 2U) + (item << 8U) + (outcome ? 1U : 0U));
    return outcome;
  }
};

/// Outcomes that are to be taken whatever the numbers say.
using ForcedOutcomes = std::map<DecisionKey, bool>;

/// Logs every decision with its margin, may force outcomes, and may perturb: each number that is
/// nudged then moves by one ulp, each component of a vector by a whole or half an ulp of its
/// largest: steps all alike would cancel too often where one quantity is nudged twice on its way.
class Watch : public Decisions<Watch> {
 public:
  static constexpr bool watches = true;

  /// perturbation 0: none.
  Watch(std::uint32_t perturbation, const ForcedOutcomes& forced)
      : perturbation_(perturbation), forced_(forced) {}

  void at_ray(std::uint32_t ray, std::size_t emitter = 0) {
    ray_ = ray;
    emitter_ = static_cast<std::uint32_t>(emitter);
  }
  void found(std::uint32_t /*triangle*/) {}
  void uses(Part /*part*/, std::size_t /*index*/) {}
  bool decide(DecisionKind kind, std::uint64_t item, bool outcome, double margin);

  template <typename Real>
  Real nudged(Real x) {
    if (perturbation_ == 0 || !std::isfinite(x)) return x;
    ++nudges_;
    return (random_bits(0) & 1U) != 0 ? x + ulp(x) : x - ulp(x);
  }
  template <typename Real>
  Vec3<Real> nudged(const Vec3<Real>& v) {
    if (perturbation_ == 0) return v;
    const Real step = ulp(largest_component(v));
    Vec3<Real> moved = v;
    ++nudges_;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t bits = random_bits(static_cast<std::uint32_t>(i));
      const Real size = (bits & 2U) != 0 ? step : step / 2;
      // What is exactly 0 is so by exact arithmetic, however it rounds elsewhere.
      if (v[i] != 0) moved[i] += (bits & 1U) != 0 ? size : -size;
    }
    return moved;
  }

  [[nodiscard]] const std::map<DecisionKey, Decision>& decisions() const { return decisions_; }

 private:
  /// Random bits for a component of the present nudge.
  [[nodiscard]] std::uint32_t random_bits(std::uint32_t component) const;

  std::uint32_t perturbation_;
  const ForcedOutcomes& forced_;
  std::uint32_t ray_ = 0;
  std::uint32_t emitter_ = 0;
  std::uint32_t nudges_ = 0;
  std::map<DecisionKey, Decision> decisions_;
};

}  // namespace facet::reference
