// Nori's tests on BSDFs made here, right and wrong ones.
#include "nori/nori_tests.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "support/lobe.h"

namespace facet::nori {

namespace {

constexpr std::uint32_t many = 200000;
constexpr double significance = 1e-3;

Verdict chi_squared(Lobe& lobe, int resolution = 10, std::uint32_t count = many) {
  const auto histogram = make_histogram(lobe, vec3(0, 0, 1), resolution, count, 7);
  EXPECT_TRUE(histogram.has_value());
  return chi_squared_test(*histogram, 5, significance);
}

TEST(ChiSquared, AcceptsSamplesOfTheirDensity) {
  for (const double exponent : {0.0, 1.0, 20.0, 1000.0}) {
    for (const double tilt : {0.0, 0.7, 1.4}) {
      for (const int resolution : {10, 7}) {
        Lobe lobe;
        lobe.exponent = lobe.claimed_exponent = exponent;
        lobe.tilt = tilt;
        const Verdict v = chi_squared(lobe, resolution);
        EXPECT_TRUE(v.passed || v.note.starts_with("nothing"))
            << exponent << " " << tilt << " " << resolution << ": p " << v.p_value << ", "
            << v.note;
      }
    }
  }
}

TEST(ChiSquared, LobesLieOnBothSides) {
  // 7 rows: one lies across the horizon.
  for (const double tilt : {1.5, 2.0, 3.0}) {
    Lobe lobe;
    lobe.exponent = lobe.claimed_exponent = 50;
    lobe.tilt = tilt;
    lobe.horizon = false;
    const Verdict v = chi_squared(lobe, 7);
    EXPECT_TRUE(v.passed) << tilt << ": p " << v.p_value << ", " << v.note;
  }
}

TEST(ChiSquared, PValuesAreUniform) {
  Lobe lobe;
  lobe.exponent = lobe.claimed_exponent = 3;
  lobe.tilt = 1;  // a part is rejected
  int low = 0;
  constexpr int runs = 200;
  for (std::uint32_t seed = 0; seed < runs; ++seed) {
    const auto histogram = make_histogram(lobe, vec3(0, 0, 1), 6, 20000, 1000 + seed);
    low += chi_squared_test(*histogram, 5, 0.5).passed ? 0 : 1;
  }
  // 200 tosses of a coin; four standard deviations.
  EXPECT_NEAR(low, runs / 2, 4 * std::sqrt(runs / 4.0));
}

TEST(ChiSquared, RejectsAnotherDensity) {
  Lobe narrower;
  narrower.claimed_exponent = 1.05;
  EXPECT_FALSE(chi_squared(narrower).passed);
  EXPECT_LT(chi_squared(narrower).p_value, significance);
  Lobe less;
  less.claimed_factor = 0.97;
  EXPECT_FALSE(chi_squared(less).passed) << "samples that the density does not know of";
  Lobe more;
  more.claimed_factor = 1.03;
  EXPECT_NE(chi_squared(more).note.find("integrates to 1.03"), std::string::npos);
}

TEST(ChiSquared, FindsNarrowPeaks) {
  // Its whole peak lies between the points of any coarse grid.
  Lobe needle;
  needle.exponent = needle.claimed_exponent = 1e7;
  needle.tilt = 0.5;
  const auto histogram = make_histogram(needle, vec3(0, 0, 1), 10, many, 3);
  ASSERT_TRUE(histogram.has_value());
  const double expected =
      std::accumulate(histogram->expected.begin(), histogram->expected.end(), 0.0);
  EXPECT_NEAR(expected / histogram->samples, 1, 1e-4);
}

/// Claims noise.
class NoisyLobe : public Lobe {
 public:
  std::vector<BsdfValue> evaluate(std::span<const DirectionPair> pairs) override {
    std::vector<BsdfValue> values;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      state_ = state_ * 1664525U + 1013904223U;
      values.push_back({vec3(0), static_cast<float>(state_ >> 8U) * 0x1p-24F});
    }
    return values;
  }

 private:
  std::uint32_t state_ = 1;
};

TEST(ChiSquared, AnIntegralThatDoesNotSettleIsNone) {
  NoisyLobe lobe;
  EXPECT_FALSE(make_histogram(lobe, vec3(0, 0, 1), 3, 1000, 1));
}

TEST(ChiSquared, SamplesWhereNoneIsExpected) {
  SphereHistogram h(1, 3);
  h.samples = 1000;
  h.expected = {500, 500, 0};
  h.observed = {500, 499, 1};
  EXPECT_NE(chi_squared_test(h, 5, significance).note.find("density is 0"), std::string::npos);
  h.observed = {500, 500, 0};
  EXPECT_TRUE(chi_squared_test(h, 5, significance).passed);
}

TEST(ChiSquared, PoolsBinsOfLowExpectation) {
  SphereHistogram h(1, 5);
  h.samples = 100;
  h.expected = {40, 47, 6, 4, 3};
  h.observed = {42, 45, 6, 0, 7};
  const Verdict whole = chi_squared_test(h, 5, significance);
  EXPECT_EQ(whole.degrees, 3) << "4 and 3 make a pool";
  EXPECT_NEAR(whole.statistic, 4.0 / 40 + 4.0 / 47, 1e-12);
  h.expected = {40, 50, 6, 4, 0};
  h.observed = {40, 50, 4, 6, 0};
  const Verdict joined = chi_squared_test(h, 5, significance);
  EXPECT_EQ(joined.degrees, 2) << "4 alone is no pool yet, 6 joins it";
  EXPECT_NEAR(joined.statistic, 0, 1e-12);
}

TEST(ChiSquared, RejectedSamplesAreOneBinMore) {
  SphereHistogram h(1, 2);
  h.samples = 100;
  h.expected = {50, 30};
  h.observed = {45, 30};
  const Verdict v = chi_squared_test(h, 5, significance);
  EXPECT_EQ(v.degrees, 2);
  EXPECT_NEAR(v.statistic, 25.0 / 50 + 25.0 / 20, 1e-12);
}

TEST(ChiSquared, DeltaLobesBelongToNoBin) {
  Lobe mixed;
  mixed.delta_share = 0.3;
  EXPECT_TRUE(chi_squared(mixed).passed);
  Lobe mirror;
  mirror.delta_share = 1;
  const Verdict v = chi_squared(mirror);
  EXPECT_FALSE(v.passed);
  EXPECT_NE(v.note.find("nothing to test"), std::string::npos);
}

TEST(TTest, ComparesMeans) {
  Lobe lobe;
  const Estimate e = sample_albedo(lobe, 30, many, 5);
  EXPECT_EQ(e.samples, many);
  // Weights are uniform on [0, 1].
  EXPECT_NEAR(e.standard_error, std::sqrt(1.0 / 12 / many), 1e-5);
  EXPECT_TRUE(t_test(e, 0.5, significance).passed);
  const Verdict wrong = t_test(e, 0.505, significance);
  EXPECT_FALSE(wrong.passed);
  EXPECT_LT(wrong.statistic, -5);
}

TEST(TTest, WithoutVarianceRoundingIsForgiven) {
  const Estimate exact{1, 0, 99999, 100000};
  EXPECT_TRUE(t_test(exact, 1, significance).passed);
  EXPECT_TRUE(t_test(exact, 1.00001, significance).passed);
  EXPECT_FALSE(t_test(exact, 1.0001, significance).passed);
  const Estimate dim{1e-6, 0, 99999, 100000};
  EXPECT_FALSE(t_test(dim, 1.0001e-6, significance).passed) << "relative, not absolute";
  const Estimate black{0, 0, 99999, 100000};
  EXPECT_TRUE(t_test(black, 0, significance).passed);
  EXPECT_FALSE(t_test(exact, 0, significance).passed);
}

TEST(TTest, BadSamplesFail) {
  Lobe lobe;
  lobe.weight = std::numeric_limits<double>::infinity();
  const Estimate e = sample_albedo(lobe, 30, 1000, 5);
  EXPECT_GT(e.bad_samples, 0);
  EXPECT_FALSE(t_test(e, e.mean, significance).passed);
}

TEST(MeanLuminance, PixelsAreStrata) {
  // Pixels differ by far more than samples of one pixel do.
  std::mt19937 engine(3);
  const auto render = [&engine](std::uint32_t) {
    std::vector<Radiance> radiances;
    for (int i = 0; i < 1000; ++i) {
      const float r = static_cast<float>(i) + static_cast<float>(engine()) * 0x1p-32F;
      radiances.push_back({r, r, r});
    }
    return radiances;
  };
  const Estimate e = mean_luminance(render, 8);
  EXPECT_EQ(e.samples, 8000);
  EXPECT_NEAR(e.standard_error, std::sqrt(1.0 / 12 / 8000), 1e-4);
  EXPECT_TRUE(t_test(e, 500, significance).passed);
  // Taken for one population, the samples would have a standard error of 3.2.
  EXPECT_FALSE(t_test(e, 500.1, significance).passed);
  // 7 of each pixel; less for variances that are estimates themselves.
  EXPECT_LE(e.degrees, 7000);
  EXPECT_GT(e.degrees, 4000);
}

TEST(PlanImage, KeepsTheShape) {
  for (const auto& [width, height, samples] :
       {std::array{1, 1, 100000}, std::array{1280, 720, 100000}, std::array{4, 3, 10},
        std::array{101, 97, 5000}, std::array{4096, 4095, 100}, std::array{16, 9, 1 << 30}}) {
    const ImagePlan plan = plan_image(width, height, static_cast<std::uint32_t>(samples));
    EXPECT_EQ(plan.width * height, plan.height * width);
    EXPECT_GE(plan.passes, 2U);
    const double drawn = static_cast<double>(plan.width) * plan.height * plan.passes;
    EXPECT_GE(drawn, samples);
    EXPECT_LE(drawn, 2.0 * std::max(samples, width * height));
  }
  EXPECT_EQ(plan_image(1, 1, 100000).width, 158);
}

}  // namespace

}  // namespace facet::nori
