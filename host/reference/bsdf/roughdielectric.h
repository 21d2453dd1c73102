#pragma once
#include "reference/bsdf/interface.h"
#include "reference/bsdf/microfacets.h"
#include "reference/bsdf/sample.h"
#include "scene/bsdf/roughdielectric.h"

namespace facet::reference {

/// B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, eq. 20 and
/// 21, i = wi, o = wo, with radiance's factor eta_o^2. wo lies above; what is below has the other
/// index.
template <typename Real>
class RoughDielectric {
 public:
  static constexpr bool transmits = true;

  template <typename Parameters>
  RoughDielectric(const bsdf::RoughDielectric& p, Parameters& at, LobeSampling sampling)
      : interface_{p.ext_ior, p.int_ior},
        tint_(at.color(p.ka)),
        microfacets_(at.roughness(p.alpha), p.options, sampling) {}

  /// Equal indices bend nothing.
  [[nodiscard]] bool delta() const { return interface_.is_none(); }
  void turn_over() { interface_.turn_over(); }
  /// (eta_i/eta_o)^2 of a refraction.
  [[nodiscard]] Real eta2() const { return interface_.eta2(); }

  template <typename Probe>
  Vec3<Real> eval(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    const Pair pair = pair_of(wo, wi, probe);
    if (!pair.valid) return Vec3<Real>(0);
    const InterfaceShares<Real> f = interface_.shares(pair.cosine, 0, probe);
    const Real g = microfacets_.masking(wo, wi, probe);
    const Real d = microfacets_.density(pair.h, probe);
    // D G over cos_i cos_o times the two ways' Jacobians: that of the density, and (eta_o/eta_i)^2
    // for radiance.
    const Real share = pair.reflected ? f.reflected : f.transmitted / eta2();
    return tint_ * (share * pair.jacobian * pair.cosine * d * g / (std::abs(wi.z) * wo.z));
  }

  template <typename Probe>
  Real pdf(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    const Pair pair = pair_of(wo, wi, probe);
    if (!pair.valid) return 0;
    const Choice choice(interface_.shares(pair.cosine, 0, probe));
    return choice.probability(pair.reflected) * directed_pdf(wo, pair, probe);
  }

  template <typename Probe>
  BsdfSample<Real> sample(const Vec3<Real>& wo, const BsdfNumbers& n, Probe& probe) const {
    if (delta()) return straight_through(wo, probe);
    const Vec3<Real> h = microfacets_.sample_half_vector(wo, n.u<Real>(), n.v<Real>(), probe);
    Pair pair{true, true, h, glm::dot(wo, h), 0};
    if (!faces(pair.cosine, probe)) return {};
    const InterfaceShares<Real> f = interface_.shares(pair.cosine, 0, probe);
    const Choice choice(f);
    pair.reflected = n.choose_first_at_last(choice.rarer, probe) == choice.reflection_is_rarer;
    const Vec3<Real> wi = pair.reflected ? 2 * pair.cosine * h - wo : refract(wo, pair, probe);
    if (is_above(wi, probe) != pair.reflected) return {};
    if (pair.reflected) pair.jacobian = jacobian_of_reflection(pair.cosine);
    const Real p = choice.probability(pair.reflected);
    const Real share = (pair.reflected ? f.reflected : f.transmitted) / p;
    const Real passed = pair.reflected ? Real(1) : eta2();
    const Real weight =
        share / passed * microfacets_.half_vector_weight(wo, wi, h, pair.cosine, probe);
    return {wi, p * directed_pdf(wo, pair, probe), tint_ * weight, passed};
  }

 private:
  /// A pair of directions and the microfacet that turns one into the other.
  struct Pair {
    bool valid = false;
    bool reflected = true;
    Vec3<Real> h{0};    ///< of any length for a pair that was given, unit for a sample
    Real cosine = 0;    ///< of wo and h
    Real jacobian = 0;  ///< solid angle of half vectors over that of wi
  };

  /// Between reflection and refraction. The rarer one keeps at least 2^-10 unless it cannot be, in
  /// whole words, of which one more or less then hardly matters.
  struct Choice {
    bool reflection_is_rarer;
    Real rarer;  ///< its probability

    explicit Choice(const InterfaceShares<Real>& f)
        : reflection_is_rarer(f.reflected <= f.transmitted),
          rarer(reflection_is_rarer ? f.reflected : f.transmitted) {
      if (rarer > 0) rarer = within_reach(std::max(rarer, Real(1) / 1024));
    }
    [[nodiscard]] Real probability(bool reflected) const {
      return reflected == reflection_is_rarer ? rarer : 1 - rarer;
    }
  };

  static Real jacobian_of_reflection(Real cosine) { return 1 / (4 * cosine); }

  /// Whether a microfacet shows its upper side, by the cosine to wo.
  template <typename Probe>
  static bool faces(Real cosine, Probe& probe) {
    return probe.positive(DecisionKind::horizon, cosine, 2);
  }

  template <typename Probe>
  Pair pair_of(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    if (is_above(wi, probe)) {
      const HalfVector<Real> half(wo, wi);
      return {true, true, half.sum, half.cosine, jacobian_of_reflection(half.cosine)};
    }
    // Towards the thinner side, of the length eta_i wi.wh + eta_o wo.wh for the unit wh.
    // outer wo + inner wi, which all but cancel where the indices are nearly equal, by their
    // difference.
    const Real bend = interface_.inner - interface_.outer;
    const Vec3<Real> sum = probe.nudged(interface_.outer * (wo + wi)) + probe.nudged(bend * wi);
    const Vec3<Real> h = interface_.outer > interface_.inner ? sum : -sum;
    const Real length = std::sqrt(glm::dot(h, h));
    const Real o = glm::dot(wo, h) / length;
    const Real i = glm::dot(wi, h) / length;
    if (!(length > 0) || !faces(std::min(o, -i), probe)) return {};
    const Real up = h.z / length;
    if (!probe.positive(DecisionKind::horizon, up, 3)) return {};
    return {true, false, h, o,
            interface_.inner * interface_.inner * std::abs(i) / (length * length)};
  }

  /// The direction refracted at the pair's half vector, and its Jacobian.
  template <typename Probe>
  Vec3<Real> refract(const Vec3<Real>& wo, Pair& pair, Probe& probe) const {
    const Real e = interface_.ratio();
    const Real beyond = interface_.refracted_cosine(1 - pair.cosine * pair.cosine, probe);
    // e c less the cosine beyond, where nearly equal indices keep their digits.
    const Real difference = interface_.ratio2_less_1() / (e * pair.cosine + beyond);
    pair.jacobian = beyond / (difference * difference);
    return difference * pair.h - e * wo;
  }

  /// Density of wi, where the kind of its lobe is settled, sr^-1.
  template <typename Probe>
  Real directed_pdf(const Vec3<Real>& wo, const Pair& pair, Probe& probe) const {
    const Real d = microfacets_.density(pair.h, probe);
    const Vec3<Real> h = unit(pair.h);
    return microfacets_.half_vector_pdf_over_cosine(wo, h, pair.cosine, d) * pair.cosine *
           pair.jacobian;
  }

  template <typename Probe>
  BsdfSample<Real> straight_through(const Vec3<Real>& wo, Probe& probe) const {
    const Real weight = microfacets_.masking(wo, wo, probe) / microfacets_.exact_masking(wo);
    return {-wo, delta_pdf<Real>, tint_ * weight};
  }

  Interface<Real> interface_;
  Vec3<Real> tint_;
  Microfacets<Real> microfacets_;
};

}  // namespace facet::reference
