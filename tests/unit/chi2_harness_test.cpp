// The chi-squared harness lets a right sampler pass and catches each planted error.
#include "statistics/chi2_harness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace facet::statistics {
namespace {

constexpr double pi = std::numbers::pi;

/// Two lobes, in double: a Beckmann one by the NDF with probability p, else the cosine hemisphere.
/// What `pdf` and `sample` believe may differ.
struct TwoLobes {
  double alpha = 0.1;
  double sampled_alpha = 0.1;
  double p = 0.5;
  double sampled_p = 0.5;
  double pdf_factor = 1;
  double delta = 0;  ///< probability of a delta lobe straight up
  bool reports_nan = false;
};

class TwoLobesEvaluator : public BsdfEvaluator {
 public:
  explicit TwoLobesEvaluator(const TwoLobes& t) : t_(t) {}

  std::vector<BsdfValue> evaluate(std::span<const DirectionPair> pairs) override {
    std::vector<BsdfValue> values;
    for (const DirectionPair& p : pairs)
      values.push_back({vec3(0), static_cast<float>(pdf(dvec3(p.wo), dvec3(p.wi)))});
    return values;
  }
  std::vector<BsdfDraw> sample(const vec3& wo, std::span<const BsdfNumbers> numbers) override {
    std::vector<BsdfDraw> draws;
    for (const BsdfNumbers& n : numbers) draws.push_back(draw(dvec3(wo), n));
    return draws;
  }
  std::vector<BsdfDraw> sample(const vec3& wo, std::uint32_t count, std::uint32_t seed) override {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1 - 0x1p-24F);
    std::vector<BsdfNumbers> numbers(count);
    for (BsdfNumbers& n : numbers) {
      n.lobe = unit(random);
      n.u = unit(random);
      n.v = unit(random);
    }
    return sample(wo, numbers);
  }

 private:
  [[nodiscard]] double pdf(const dvec3& wo, const dvec3& wi) const {
    if (wi.z <= 0) return 0;
    const dvec3 h = glm::normalize(wo + wi);
    const double cos2 = h.z * h.z;
    const double a2 = t_.alpha * t_.alpha;
    const double d = std::exp(-(h.x * h.x + h.y * h.y) / (cos2 * a2)) / (pi * a2 * cos2 * cos2);
    const double lobes = t_.p * d * h.z / (4 * glm::dot(wo, h)) + (1 - t_.p) * wi.z / pi;
    return (1 - t_.delta) * t_.pdf_factor * lobes;
  }
  [[nodiscard]] BsdfDraw draw(const dvec3& wo, const BsdfNumbers& n) const {
    if (n.lobe < t_.delta) return {vec3(0, 0, 1), -1, vec3(1)};
    const double lobe = (n.lobe - t_.delta) / (1 - t_.delta);
    const double azimuth = 2 * pi * n.v;
    dvec3 wi(std::sqrt(n.u) * std::cos(azimuth), std::sqrt(n.u) * std::sin(azimuth),
             std::sqrt(1 - n.u));
    if (lobe < t_.sampled_p) {
      const double tangent = t_.sampled_alpha * std::sqrt(-std::log1p(-static_cast<double>(n.u)));
      const double c = 1 / std::sqrt(1 + tangent * tangent);
      const dvec3 h(tangent * c * std::cos(azimuth), tangent * c * std::sin(azimuth), c);
      wi = 2 * glm::dot(wo, h) * h - wo;
    }
    if (wi.z <= 0) return {vec3(wi), 0, vec3(0)};
    return {vec3(wi), static_cast<float>(pdf(wo, wi)),
            vec3(t_.reports_nan && n.u > 0.5F ? NAN : 1.0F)};
  }

  TwoLobes t_;
};

Chi2Result test(const TwoLobes& t, const vec3& wo, std::uint32_t seed = 1,
                std::uint32_t samples = 400'000) {
  TwoLobesEvaluator evaluator(t);
  Chi2Options options;
  options.seed = seed;
  options.samples = samples;
  return test_sampling(evaluator, wo, options, 1e-4);
}

const vec3 oblique(0.48F, 0.64F, 0.6F);

TEST(Chi2Harness, passes_what_is_right_however_narrow_and_grazing) {
  std::uint32_t seed = 10;
  for (const double alpha : {1e-3, 0.01, 0.1, 1.0}) {
    for (const float z : {1.0F, 0.9999F, 0.6F, 0.03F}) {
      const float r = std::sqrt((1 - z) * (1 + z));
      for (const double p : {1.0, 0.5, 0.001}) {
        const Chi2Result result = test({alpha, alpha, p, p}, {0, r, z}, seed += 2, 120'000);
        EXPECT_EQ(result.fault, "") << alpha << ' ' << z << ' ' << p;
        EXPECT_GE(result.populated_bins, 200U);
        EXPECT_NEAR(result.pdf_integral + result.rejected_share, 1, 6e-3);
        EXPECT_LT(result.integral_error, 2e-4);
      }
    }
  }
}

TEST(Chi2Harness, p_values_of_what_is_right_are_uniform) {
  // Mean of 64 uniform numbers: 1/2, standard deviation 0.036.
  double sum = 0;
  for (std::uint32_t k = 0; k < 64; ++k) {
    TwoLobesEvaluator evaluator({0.2, 0.2});
    Chi2Options options;
    options.samples = 50'000;
    options.pilots = 1U << 14U;
    options.bins = 64;
    options.least_bins = 32;
    options.seed = 1000 + 2 * k;
    sum += test_sampling(evaluator, oblique, options, 1e-6).p_value;
  }
  EXPECT_NEAR(sum / 64, 0.5, 0.12);
}

TEST(Chi2Harness, catches_a_density_two_percent_too_large) {
  TwoLobes t;
  t.pdf_factor = 1.02;
  EXPECT_LT(test(t, oblique).p_value, 1e-4);
  t.pdf_factor = 0.98;
  EXPECT_LT(test(t, oblique).p_value, 1e-4);
}

TEST(Chi2Harness, catches_a_lobe_probability_off_by_two_percent) {
  TwoLobes t;
  t.sampled_p = 0.51;
  EXPECT_LT(test(t, oblique).p_value, 1e-4);
}

TEST(Chi2Harness, catches_a_roughness_off_by_five_percent) {
  for (const double alpha : {1e-3, 0.1, 0.6}) {
    EXPECT_LT(test({alpha, 1.05 * alpha, 1, 1}, oblique).p_value, 1e-4) << alpha;
  }
}

TEST(Chi2Harness, counts_delta_lobes_by_direction) {
  TwoLobes t;
  t.delta = 0.25;
  const Chi2Result result = test(t, oblique);
  EXPECT_EQ(result.fault, "");
  ASSERT_EQ(result.deltas.size(), 1U);
  EXPECT_EQ(result.deltas[0].wi, vec3(0, 0, 1));
  EXPECT_NEAR(static_cast<double>(result.deltas[0].count), 100'000, 1500);
  EXPECT_NEAR(result.pdf_integral, 0.75, 1e-3);
}

TEST(Chi2Harness, a_delta_lobe_that_the_density_does_not_leave_room_for_is_caught) {
  TwoLobes t;
  t.delta = 0.25;
  t.pdf_factor = 1 / 0.75;
  EXPECT_LT(test(t, oblique).p_value, 1e-4);
}

TEST(Chi2Harness, reports_bad_samples) {
  TwoLobes t;
  t.reports_nan = true;
  const Chi2Result result = test(t, oblique);
  EXPECT_GT(result.bad_samples, 100'000U);
  EXPECT_NE(result.fault, "");
}

TEST(Chi2Harness, fails_where_bins_are_few) {
  TwoLobesEvaluator evaluator({});
  Chi2Options options;
  options.samples = 300;
  EXPECT_NE(test_sampling(evaluator, oblique, options, 1e-4).fault.find("bins"), std::string::npos);
}

}  // namespace
}  // namespace facet::statistics
