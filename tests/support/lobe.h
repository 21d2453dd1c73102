#pragma once
// A BSDF made for tests of tests: its density is known, and it may lie about it.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "nori/nori_tests.h"

namespace facet::nori {

using statistics::BsdfDraw;
using statistics::BsdfNumbers;
using statistics::BsdfValue;
using statistics::DirectionPair;

inline constexpr double pi = std::numbers::pi;

/// Draws directions whose density is (n + 1) / 2 pi cos^n around an axis in the upper hemisphere;
/// what falls below the horizon is rejected. Claims a density that may be off.
class Lobe : public BsdfEvaluator {
 public:
  double exponent = 1;
  double claimed_exponent = 1;
  double tilt = 0;  ///< of the axis, radians, towards +x
  double claimed_factor = 1;
  double delta_share = 0;  ///< samples that are a delta lobe's
  double weight = 0.5;
  bool horizon = true;  ///< whether what lies below it is rejected

  std::vector<BsdfValue> evaluate(std::span<const DirectionPair> pairs) override {
    std::vector<BsdfValue> values;
    for (const DirectionPair& pair : pairs) {
      // Of a float direction, the length is less precise than the place.
      const dvec3 d = glm::normalize(dvec3(pair.wi)) - axis();
      const double cosine = 1 - glm::dot(d, d) / 2;
      const bool seen = (pair.wi.z > 0 || !horizon) && cosine > 0;
      const double n = claimed_exponent;
      const double pdf =
          seen ? (n + 1) / (2 * pi) * std::pow(cosine, n) * (1 - delta_share) * claimed_factor : 0;
      values.push_back({vec3(0), static_cast<float>(pdf)});
    }
    return values;
  }
  std::vector<BsdfDraw> sample(const vec3&, std::span<const BsdfNumbers> numbers) override {
    std::vector<BsdfDraw> draws;
    for (const BsdfNumbers& n : numbers) draws.push_back(draw(n));
    return draws;
  }
  std::vector<BsdfDraw> sample(const vec3& wo, std::uint32_t count, std::uint32_t seed) override {
    std::mt19937 engine(seed + 1);
    const auto number = [&engine] { return static_cast<float>(engine() >> 8U) * 0x1p-24F; };
    std::vector<BsdfNumbers> numbers(count);
    for (BsdfNumbers& n : numbers) {
      n.lobe = number();
      n.u = number();
      n.v = number();
    }
    return sample(wo, numbers);
  }

 private:
  [[nodiscard]] dvec3 axis() const { return {std::sin(tilt), 0, std::cos(tilt)}; }
  [[nodiscard]] BsdfDraw draw(const BsdfNumbers& n) const {
    if (n.lobe < delta_share) return {vec3(0, 0, 1), -1, vec3(static_cast<float>(weight))};
    const double cosine = std::pow(1.0 - n.u, 1 / (exponent + 1));
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const dvec3 tangent(std::cos(tilt), 0, -std::sin(tilt));
    const double phi = 2 * pi * n.v;
    const dvec3 w =
        cosine * axis() + sine * (std::cos(phi) * tangent + std::sin(phi) * dvec3(0, 1, 0));
    if (w.z <= 0 && horizon) return {};
    return {vec3(w), 1, vec3(static_cast<float>(2 * weight * n.lobe))};
  }
};

}  // namespace facet::nori
