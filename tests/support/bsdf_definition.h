#pragma once
// The rough models written out plainly from their definitions.
#include <array>
#include <cmath>
#include <numbers>

#include "support/bsdfs.h"

namespace facet::test {

/// A misreading that kernels and reference shared would show against it. Parameters are those of
/// rough_bsdfs.
class BsdfDefinition {
 public:
  BsdfDefinition(double alpha, const bsdf::MicrofacetOptions& options)
      : alpha_(alpha), options_(options) {}

  /// f(wo, wi) in channel k, by name.
  [[nodiscard]] double value(const std::string& name, const dvec3& wo, const dvec3& wi,
                             int k) const {
    const double warm = std::array{0.9, 0.5, 0.1}.at(static_cast<std::size_t>(k));
    const double cold = std::array{0.2, 0.5, 0.7}.at(static_cast<std::size_t>(k));
    if (name == "roughdielectric") return warm * interface(wo, wi);
    const dvec3 h = glm::normalize(wo + wi);
    const double c = glm::dot(h, wi);
    const double gloss = distribution(h) * g1(wi) * g1(wo) / (4 * wi.z * wo.z);
    const auto under = [](double cosine) { return 1 - std::pow(1 - cosine / 2, 5); };
    const double base = 28 / (23 * std::numbers::pi) * under(wi.z) * under(wo.z);
    const auto schlick = [c](double r) { return r + (1 - r) * std::pow(1 - c, 5); };
    if (name == "roughconductor") return gloss * schlick(warm);
    if (name == "roughsubstrate") return cold * base * (1 - 0.04) + gloss * fresnel(c, 1, 1.5);
    if (name == "microfacet")
      return cold / std::numbers::pi + (1 - 0.7) * gloss * fresnel(c, 1, 1.5);
    return cold * (1 - warm / 2) * base +
           distribution(h) * schlick(warm / 2) / (4 * std::abs(c) * std::max(wi.z, wo.z));
  }

 private:
  [[nodiscard]] double distribution(const dvec3& h) const {
    if (h.z <= 0) return 0;
    const double tan2 = 1 / (h.z * h.z) - 1;
    const double a2 = alpha_ * alpha_;
    if (options_.distribution == bsdf::Distribution::ggx)
      return a2 / (std::numbers::pi * std::pow(h.z * h.z * (a2 - 1) + 1, 2));
    if (tan2 / a2 >= 87) return 0;  // docs/sampling.md
    return std::exp(-tan2 / a2) / (std::numbers::pi * a2 * std::pow(h.z, 4));
  }

  [[nodiscard]] double g1(const dvec3& w) const {
    const double tangent = std::tan(std::acos(std::abs(w.z)));
    if (options_.distribution == bsdf::Distribution::ggx)
      return 2 / (1 + std::sqrt(1 + alpha_ * alpha_ * tangent * tangent));
    const double b = 1 / (alpha_ * tangent);
    if (options_.masking == Masking::exact)
      return 1 /
             (1 + (std::erf(b) - 1) / 2 + std::exp(-b * b) / (2 * b * std::sqrt(std::numbers::pi)));
    return b >= 1.6 ? 1 : (3.535 * b + 2.181 * b * b) / (1 + 2.276 * b + 2.577 * b * b);
  }

  [[nodiscard]] static double fresnel(double c, double from, double to) {
    const double sine = from / to * std::sqrt(1 - c * c);
    if (sine >= 1) return 1;
    const double t = std::sqrt(1 - sine * sine);
    const double rs = (from * c - to * t) / (from * c + to * t);
    const double rp = (to * c - from * t) / (to * c + from * t);
    return (rs * rs + rp * rp) / 2;
  }

  /// Walter et al. 2007, eq. 20 and 21, with the normal up on the outer side.
  [[nodiscard]] double interface(const dvec3& wo, const dvec3& wi) const {
    const double eta_o = wo.z > 0 ? 1 : 1.5;
    const double eta_i = wi.z > 0 ? 1 : 1.5;
    const bool reflected = wo.z * wi.z > 0;
    dvec3 h = reflected ? glm::normalize(wo + wi) : glm::normalize(eta_o * wo + eta_i * wi);
    if (h.z < 0) h = -h;
    const double o = glm::dot(wo, h);
    const double i = glm::dot(wi, h);
    if (o / wo.z <= 0 || i / wi.z <= 0) return 0;
    const double f = fresnel(std::abs(o), eta_o, wo.z > 0 ? 1.5 : 1);
    const double dg = distribution(h) * g1(wi) * g1(wo);
    if (reflected) return f * dg / (4 * std::abs(wi.z * wo.z));
    return std::abs(i * o) / std::abs(wi.z * wo.z) * eta_o * eta_o * (1 - f) * dg /
           std::pow(eta_i * i + eta_o * o, 2);
  }

  double alpha_;
  bsdf::MicrofacetOptions options_;
};

}  // namespace facet::test
