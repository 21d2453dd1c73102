#pragma once
// A surface of microfacets, whichever their distribution, their masking and how their normals are
// sampled.
#include "reference/bsdf/beckmann.h"
#include "reference/bsdf/ggx.h"
#include "scene/bsdf/rough.h"
#include "scene/settings.h"

namespace facet::reference {

template <typename Real>
class Microfacets {
 public:
  Microfacets(Real alpha, const bsdf::MicrofacetOptions& options, LobeSampling sampling)
      : alpha_(alpha),
        ggx_(options.distribution == bsdf::Distribution::ggx),
        exact_(ggx_ || options.masking == Masking::exact),
        visible_(sampling != LobeSampling::ndf) {}

  /// D(h) in sr^-1 for a vector h of any length.
  template <typename Probe>
  Real density(const Vec3<Real>& h, Probe& probe) const {
    return with_law([&](const auto& law) { return law.density(h, probe); });
  }

  /// Separable G of a pair of directions.
  template <typename Probe>
  Real masking(const Vec3<Real>& wo, const Vec3<Real>& wi, Probe& probe) const {
    if (exact_) return exact_masking(wi) * exact_masking(wo);
    const Beckmann<Real> law(alpha_);
    return law.rational_masking(wi, 0, probe) * law.rational_masking(wo, 1, probe);
  }

  /// Smith's G1, the normalisation of the visible normals.
  Real exact_masking(const Vec3<Real>& w) const {
    return with_law([&](const auto& law) { return law.exact_masking(w); });
  }

  /// Unit half vector by the chosen strategy.
  template <typename Probe>
  Vec3<Real> sample_half_vector(const Vec3<Real>& wo, Real u, Real v, Probe& probe) const {
    return probe.nudged(with_law([&](const auto& law) {
      return visible_ ? law.sample_visible(wo, u, v, probe) : law.sample_density(u, v, probe);
    }));
  }

  /// Density of the unit half vector h seen from wo under the cosine wo.h, over that cosine, sr^-1,
  /// where D(h) is already known. A reflected direction has a quarter of it.
  Real half_vector_pdf_over_cosine(const Vec3<Real>& wo, const Vec3<Real>& h, Real o_dot_h,
                                   Real d) const {
    return visible_ ? exact_masking(wo) * d / wo.z : d * h.z / o_dot_h;
  }

  /// G D (wo.h)/cos_o over the density of the unit half vector h: D cancels.
  template <typename Probe>
  Real half_vector_weight(const Vec3<Real>& wo, const Vec3<Real>& wi, const Vec3<Real>& h,
                          Real o_dot_h, Probe& probe) const {
    const Real g = masking(wo, wi, probe);
    return visible_ ? g / exact_masking(wo) : g * o_dot_h / (wo.z * h.z);
  }

 private:
  template <typename Function>
  auto with_law(const Function& f) const {
    return ggx_ ? f(Ggx<Real>(alpha_)) : f(Beckmann<Real>(alpha_));
  }

  Real alpha_;
  bool ggx_;
  bool exact_;
  bool visible_;
};

/// The half vector of a reflected pair of directions. Where found from the directions it is not
/// normalised: each component of the sum is exact to half an ulp, and wo.h = |h|^2/2 does not
/// cancel.
template <typename Real>
struct HalfVector {
  Vec3<Real> sum;
  Vec3<Real> unit_h;
  Real cosine;  ///< wo.h/|h| = |h|/2

  HalfVector(const Vec3<Real>& wo, const Vec3<Real>& wi)
      : sum(wo + wi),
        unit_h(unit(sum)),
        cosine(std::min(std::sqrt(glm::dot(sum, sum)) / 2, Real(1))) {}
  /// Of a sample: unit h.
  HalfVector(const Vec3<Real>& h, Real o_dot_h) : sum(h), unit_h(h), cosine(o_dot_h) {}

  [[nodiscard]] Vec3<Real> reflect(const Vec3<Real>& wo) const { return 2 * cosine * unit_h - wo; }
};

}  // namespace facet::reference
