// Every BSDF of the shared list, on the kernels: values are those of the reference in double, and
// reciprocal; weights are value times cosine over density; nothing is undefined at the limits.
#include <cmath>
#include <numbers>

#include "reference/reference_bsdf_evaluator.h"
#include "support/bsdf_kernels.h"

namespace facet::test {
namespace {

using statistics::BsdfDraw;
using statistics::BsdfNumbers;
using statistics::BsdfValue;
using statistics::DirectionPair;

std::string describe(const BsdfCase& c, const DirectionPair& p) {
  return fmt::format("{}, wi ({}, {}, {})", describe(c, p.wo), p.wi.x, p.wi.y, p.wi.z);
}

class BsdfValues : public BsdfTest {};

/// How well the value of a pair of directions can be known.
struct Conditioning {
  /// Of D: its exponent, or how far up the flank.
  double slope = 1;
  /// Relative change of the share that is reflected or refracted where a cosine is rounded: beside
  /// the critical angle reflectance has an infinite slope, and what is refracted vanishes.
  double reflectance = 0;
  /// Relative change of D where a direction is rounded; where the products are that a refracted
  /// pair's half vector is made of.
  double rounding = 0;
  double products = 0;

  /// Relative difference that is allowed.
  [[nodiscard]] double allowed() const { return std::max(1e-5 * slope, reflectance) + products; }
};

/// Unpolarised reflectance by the cosines on both sides.
double reflectance(double eta_i, double cos_i, double eta_t, double cos_t) {
  const double s = (eta_i * cos_i - eta_t * cos_t) / (eta_i * cos_i + eta_t * cos_t);
  const double p = (eta_t * cos_i - eta_i * cos_t) / (eta_t * cos_i + eta_i * cos_t);
  return 0.5 * (s * s + p * p);
}

/// Largest relative change of what is reflected, or of what is refracted (the cosines times the
/// share), by rounding: four roundings of a dot product of unit vectors, eight of the squared
/// cosine beyond, each of at most the greater of 1 and the squared ratio.
double change_by_rounding(double eta_i, double cos_i, double eta_t, bool reflects) {
  if (eta_i == eta_t) return 0;
  constexpr double rounding = 0x1p-24;
  const double ratio2 = std::pow(eta_i / eta_t, 2);
  const auto value = [&](double c_i, double cos2_error) {
    const double c_t = std::sqrt(std::max(1 - ratio2 * (1 - c_i * c_i) + cos2_error, 0.0));
    const double f = reflectance(eta_i, c_i, eta_t, c_t);
    return reflects ? f : c_i * c_t * (1 - f);
  };
  const double exact = value(cos_i, 0);
  double change = 0;
  for (const double a : {-4, 4}) {
    for (const double b : {-8, 8}) {
      const double off =
          value(std::clamp(cos_i + a * rounding, 0.0, 1.0), b * rounding * std::max(1.0, ratio2));
      if (std::max(exact, off) > 0)
        change = std::max(change, std::abs(off - exact) / std::max(exact, off));
    }
  }
  return change;
}

Conditioning conditioning(const BsdfCase& c, const DirectionPair& p) {
  const bool reflects = (p.wo.z > 0) == (p.wi.z > 0);
  const double eta_o = c.index_at(p.wo);
  const double eta_i = c.index_at(reflects ? -p.wo : p.wi);
  const dvec3 h = dvec3(p.wo) * (reflects ? 1 : eta_o) + dvec3(p.wi) * (reflects ? 1 : eta_i);
  const double alpha = c.alpha();
  const double tangent = std::sqrt(h.x * h.x + h.y * h.y) / std::abs(h.z);
  Conditioning result;
  result.slope = std::max(1.0, tangent * tangent / (alpha * alpha) / 10);
  result.rounding = 2 * (1 + tangent / alpha) * (0x1p-23 / std::abs(h.z)) / alpha;
  if (!reflects) result.products = result.rounding * std::abs(eta_i - eta_o);
  const double cosine = std::abs(glm::dot(dvec3(p.wo), glm::normalize(h)));
  result.reflectance =
      change_by_rounding(eta_o, cosine, reflects ? c.index_at(-p.wo) : eta_i, reflects);
  return result;
}

/// Pairs to evaluate: samples, which lie in the lobes, and directions all over the sphere.
std::vector<DirectionPair> pairs_of(const BsdfCase& c, KernelBsdfEvaluator& kernels) {
  std::vector<DirectionPair> pairs;
  const std::vector<vec3> directions = view_directions(c);
  for (std::size_t d = 0; d < directions.size(); ++d) {
    for (const BsdfDraw& draw :
         kernels.sample(directions[d], 192, static_cast<std::uint32_t>(c.number + d))) {
      if (draw.weight != vec3(0) && draw.pdf > 0) pairs.push_back({directions[d], draw.wi});
    }
    for (const vec3& wi : directions) pairs.push_back({directions[d], {wi.y, -wi.x, wi.z}});
  }
  return pairs;
}

bool is_value(const BsdfValue& v) {
  return std::isfinite(v.pdf) && v.pdf >= 0 && std::isfinite(v.f.x + v.f.y + v.f.z) &&
         glm::all(glm::greaterThanEqual(v.f, vec3(0)));
}

/// Relative difference in units of what is allowed.
class Comparison {
 public:
  /// least: what counts as nothing.
  void add(double a, double b, double allowed, double least, const std::string& where) {
    const double largest = std::max({std::abs(a), std::abs(b), least});
    // Below, D is all but gone: kernels cut it at e^-87.
    if (largest < 1e-25) return;
    const double share = std::abs(a - b) / largest / allowed;
    if (share > worst_) worst_ = share, where_ = fmt::format("{}: {} and {}", where, a, b);
    ++count_;
  }
  /// A channel without reflectance of its own, (1 - c)^5, is compared in units of a millionth of
  /// the largest.
  void add(const vec3& a, const vec3& b, double allowed, const std::string& where) {
    const double least = 1e-6 * static_cast<double>(std::max({a.x, a.y, a.z}));
    for (int k = 0; k < 3; ++k) add(a[k], b[k], allowed, least, where);
  }
  void expect(std::size_t least_count) const {
    EXPECT_LE(worst_, 1) << where_;
    EXPECT_GE(count_, least_count);
    std::printf("worst difference %.3f of what is allowed, of %zu: %s\n", worst_, count_,
                where_.c_str());
  }

 private:
  double worst_ = 0;
  std::size_t count_ = 0;
  std::string where_;
};

TEST_P(BsdfValues, values_are_those_of_the_reference) {
  Comparison values;
  bool smooth = false;
  for (const BsdfCase& c : bsdf_cases(GetParam())) {
    KernelBsdfEvaluator kernels = kernels_of(c);
    reference::ReferenceBsdfEvaluator<double> reference(c.bsdf, c.sampling);
    const std::vector<DirectionPair> pairs = pairs_of(c, kernels);
    const std::vector<BsdfValue> found = kernels.evaluate(pairs);
    const std::vector<BsdfValue> right = reference.evaluate(pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const std::string where = describe(c, pairs[i]);
      EXPECT_TRUE(is_value(found[i])) << where;
      const double allowed = conditioning(c, pairs[i]).allowed();
      values.add(found[i].f, right[i].f, allowed, where);
      // A lobe's probability has 24 bits.
      const double least =
          0x1p-23 * std::abs(static_cast<double>(pairs[i].wi.z)) / (allowed * std::numbers::pi);
      values.add(found[i].pdf, right[i].pdf, allowed, least, "density, " + where);
    }
    smooth = smooth || (!found.empty() && found[0].pdf == 0 && c.has_flag(shared::BSDF_DELTA));
  }
  values.expect(smooth ? 0 : 1000);
}

TEST_P(BsdfValues, values_are_reciprocal) {
  Comparison values;
  for (const BsdfCase& c : bsdf_cases(GetParam())) {
    // Compensation is by wo's albedo alone.
    if (c.has_flag(shared::BSDF_MULTISCATTER)) continue;
    KernelBsdfEvaluator kernels = kernels_of(c);
    const std::vector<DirectionPair> pairs = pairs_of(c, kernels);
    std::vector<DirectionPair> swapped;
    for (const DirectionPair& p : pairs) swapped.push_back({p.wi, p.wo});
    const std::vector<BsdfValue> there = kernels.evaluate(pairs);
    const std::vector<BsdfValue> back = kernels.evaluate(swapped);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto eta2_o = static_cast<float>(std::pow(c.index_at(pairs[i].wo), 2));
      const auto eta2_i = static_cast<float>(std::pow(c.index_at(pairs[i].wi), 2));
      const double allowed =
          conditioning(c, pairs[i]).allowed() + conditioning(c, swapped[i]).allowed();
      values.add(there[i].f / eta2_o, back[i].f / eta2_i, allowed, describe(c, pairs[i]));
    }
  }
  values.expect(0);
}

/// Every combination of the least, a middling and the largest number.
std::vector<BsdfNumbers> extreme_numbers() {
  std::vector<BsdfNumbers> numbers;
  for (const float lobe : {0.0F, 0.5F, 1 - 0x1p-24F}) {
    for (const float u : {0.0F, 0.5F, 1 - 0x1p-24F}) {
      for (const float v : {0.0F, 0.5F, 1 - 0x1p-24F}) numbers.push_back({lobe, u, v});
    }
  }
  return numbers;
}

TEST_P(BsdfValues, weights_are_value_times_cosine_over_density) {
  Comparison weights;
  const std::vector<BsdfNumbers> extremes = extreme_numbers();
  for (const BsdfCase& c : bsdf_cases(GetParam())) {
    KernelBsdfEvaluator kernels = kernels_of(c);
    for (const vec3& wo : view_directions(c)) {
      std::vector<BsdfDraw> draws =
          kernels.sample(wo, 512, static_cast<std::uint32_t>(c.number + 7));
      for (const BsdfDraw& d : kernels.sample(wo, extremes)) draws.push_back(d);
      std::vector<DirectionPair> pairs;
      for (const BsdfDraw& d : draws) pairs.push_back({wo, d.wi});
      const std::vector<BsdfValue> values = kernels.evaluate(pairs);
      for (std::size_t i = 0; i < draws.size(); ++i) {
        const BsdfDraw& d = draws[i];
        ASSERT_TRUE(is_value({d.weight, std::max(d.pdf, 0.0F)}))
            << describe(c, wo) << ", sample " << i;
        if (d.weight == vec3(0) || d.pdf < 0) continue;
        EXPECT_NEAR(glm::length(dvec3(d.wi)), 1, 1e-6) << describe(c, wo);
        if (!(values[i].pdf > 1e-20F)) continue;
        // Seen from outside, the direction is rounded.
        const Conditioning known = conditioning(c, pairs[i]);
        weights.add(d.weight, values[i].f * (std::abs(d.wi.z) / values[i].pdf),
                    known.allowed() + known.rounding,
                    fmt::format("{}, sample {}", describe(c, pairs[i]), i));
      }
    }
  }
  weights.expect(0);
}

/// Directions at the limits: along the normal, all but in the surface, and on the other side.
std::vector<vec3> extreme_directions() {
  std::vector<vec3> directions;
  for (const float z : {1.0F, 0.5F, 1e-4F, 1e-7F}) {
    const float r = std::sqrt((1 - z) * (1 + z));
    for (const float side : {1.0F, -1.0F}) {
      directions.emplace_back(r, 0, side * z);
      directions.emplace_back(-r, 0, side * z);
      directions.emplace_back(0, r, side * z);
    }
  }
  return directions;
}

TEST_P(BsdfValues, nothing_is_nan_infinite_or_negative_at_the_limits) {
  const std::vector<vec3> directions = extreme_directions();
  std::vector<DirectionPair> pairs;
  for (const vec3& wo : directions) {
    for (const vec3& wi : directions) pairs.push_back({wo, wi});
  }
  for (const BsdfCase& c : bsdf_cases(GetParam())) {
    KernelBsdfEvaluator kernels = kernels_of(c);
    const std::vector<BsdfValue> values = kernels.evaluate(pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      EXPECT_TRUE(is_value(values[i])) << describe(c, pairs[i]);
      EXPECT_TRUE(c.transmits() || (pairs[i].wo.z > 0 && pairs[i].wi.z > 0) || values[i].pdf == 0)
          << describe(c, pairs[i]);
    }
    for (const vec3& wo : directions) {
      for (const BsdfDraw& d : kernels.sample(wo, extreme_numbers()))
        EXPECT_TRUE(is_value({d.weight, d.weight == vec3(0) ? 0 : std::abs(d.pdf)}))
            << describe(c, wo);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, BsdfValues, testing::Range<std::size_t>(0, bsdf_type_names.size()),
                         name_of);

}  // namespace
}  // namespace facet::test
