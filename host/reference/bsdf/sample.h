#pragma once
// What sampling a BSDF gives. Directions are unit, in the shading frame, z along the shading
// normal.
#include "reference/choice.h"
#include "reference/probe.h"
#include "reference/random.h"
#include "reference/real.h"
#include "shared/records.h"

namespace facet::reference {

/// Stands for the density of a delta lobe.
template <typename Real>
inline constexpr Real delta_pdf = static_cast<Real>(shared::DELTA_PDF);

template <typename Real>
struct BsdfSample {
  Vec3<Real> wi{0, 0, 1};
  Real pdf = 0;          ///< sr^-1, or delta_pdf
  Vec3<Real> weight{0};  ///< f cos / pdf; 0 where the sample is rejected
  Real eta2 = 1;         ///< (eta_i/eta_o)^2 of a refraction
};

/// Base of models that scatter into single directions only: between any two there is nothing.
template <typename Real>
struct DeltaLobes {
  [[nodiscard]] bool delta() const { return true; }
  template <typename Probe>
  Vec3<Real> eval(const Vec3<Real>& /*wo*/, const Vec3<Real>& /*wi*/, Probe& /*probe*/) const {
    return Vec3<Real>(0);
  }
  template <typename Probe>
  Real pdf(const Vec3<Real>& /*wo*/, const Vec3<Real>& /*wi*/, Probe& /*probe*/) const {
    return 0;
  }
};

/// Words of a BSDF sample (docs/reference/sampling.md, "BSDF sample").
class BsdfNumbers {
 public:
  BsdfNumbers(std::uint32_t lobe, std::uint32_t u, std::uint32_t v) : lobe_(lobe), u_(u), v_(v) {}
  explicit BsdfNumbers(const Block& block)
      : BsdfNumbers(block.word(shared::BSDF_LOBE), block.word(shared::BSDF_U),
                    block.word(shared::BSDF_V)) {}

  template <typename Real>
  [[nodiscard]] Real u() const {
    return number_of<Real>(u_);
  }
  template <typename Real>
  [[nodiscard]] Real v() const {
    return number_of<Real>(v_);
  }

  /// Whether the first of two lobes is chosen, of probability p; u keeps the remainder.
  template <typename Real, typename Probe>
  [[nodiscard]] bool choose_first(Real p, Probe& probe) {
    const TwoWayChoice choice(static_cast<double>(p));
    const bool first = probe.below(DecisionKind::lobe, share_of(u_), choice.probability());
    u_ = choice.remainder(first, u_, lobe_);
    return first;
  }
  /// The same where u and v have been used.
  template <typename Real, typename Probe>
  [[nodiscard]] bool choose_first_at_last(Real p, Probe& probe) const {
    const TwoWayChoice choice(static_cast<double>(p));
    return probe.below(DecisionKind::lobe, share_of(lobe_), choice.probability());
  }

 private:
  /// The share of all words that lie below one.
  static double share_of(std::uint32_t word) { return std::ldexp(static_cast<double>(word), -32); }

  std::uint32_t lobe_;
  std::uint32_t u_;
  std::uint32_t v_;
};

/// Whether a direction lies above the surface.
template <typename Real, typename Probe>
[[nodiscard]] bool is_above(const Vec3<Real>& w, Probe& probe) {
  return probe.positive(DecisionKind::horizon, w.z);
}

/// A probability p of whole words, within 2^-24 from both sides unless one side has no value.
template <typename Real>
[[nodiscard]] Real within_reach(Real p) {
  constexpr Real step = Real(1) / 16777216;
  if (!(p > 0 && p < 1)) return p;
  return static_cast<Real>(
      TwoWayChoice(static_cast<double>(std::clamp(p, step, 1 - step))).probability());
}

/// Direction with density cos/pi.
template <typename Real>
[[nodiscard]] Vec3<Real> cosine_direction(Real u, Real v) {
  Real sine = 0;
  Real cosine = 0;
  sin_cos_turns(v, sine, cosine);
  const Real radius = std::sqrt(u);
  return {radius * cosine, radius * sine, std::sqrt(1 - u)};
}

/// Direction with equal density over the upper hemisphere (height 1) or the sphere (height 2).
template <typename Real>
[[nodiscard]] Vec3<Real> uniform_direction(Real u, Real v, Real height) {
  Real sine = 0;
  Real cosine = 0;
  sin_cos_turns(v, sine, cosine);
  const Real z = 1 - height * u;
  const Real radius = std::sqrt(height * u * (1 + z));
  return {radius * cosine, radius * sine, z};
}

}  // namespace facet::reference
