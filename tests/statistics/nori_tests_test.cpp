// Nori's tests on BSDFs made here, right and wrong ones.
#include "nori/nori_tests.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace facet::nori {

using statistics::BsdfDraw;
using statistics::BsdfNumbers;
using statistics::BsdfValue;
using statistics::DirectionPair;
using statistics::integrate_expected;
using statistics::sphere_point;
using statistics::SpherePoint;

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::uint32_t many = 200000;
constexpr double significance = 1e-3;

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

/// A grey image of every sample; it counts them.
class GreyRendering : public Rendering {
 public:
  GreyRendering(const RenderSettings& settings, std::size_t& samples)
      : settings_(settings), samples_(samples) {}
  void run(const ProgressCallback& /*progress*/) override {}
  std::vector<Radiance> sample(std::uint32_t /*index*/) override {
    const auto pixels = static_cast<std::size_t>(settings_.size.width * settings_.size.height);
    samples_ += pixels;
    return std::vector<Radiance>(pixels, {0.25F, 0.25F, 0.25F});
  }
  Film film() const override { return {}; }
  const RenderStatistics& statistics() const override { return statistics_; }

 private:
  RenderSettings settings_;
  std::size_t& samples_;
  RenderStatistics statistics_;
};

class FakeBackend : public TestableBackend {
 public:
  std::string name() const override { return "fake"; }
  std::string driver() const override { return "none"; }
  using TestableBackend::start;
  std::unique_ptr<Rendering> start(const ScenePtr& scene, const RenderSettings& settings) override {
    EXPECT_TRUE(std::holds_alternative<BoxFilter>(scene->camera.filter));
    EXPECT_EQ(settings.sampler, Sampler::independent);
    EXPECT_EQ(settings.size.width * 3, settings.size.height * 4);
    EXPECT_EQ(settings.crop_width(), settings.size.width);
    EXPECT_EQ(settings.crop_height(), settings.size.height);
    return std::make_unique<GreyRendering>(settings, samples);
  }
  std::unique_ptr<BsdfEvaluator> evaluator(const Bsdf& /*bsdf*/,
                                           LobeSampling /*sampling*/) override {
    auto lobe = std::make_unique<Lobe>();
    weight += weight_step;
    lobe->weight = weight;
    return lobe;
  }

  std::size_t samples = 0;
  double weight = 0.5;  ///< of the last evaluator
  double weight_step = 0;
};

/// Two BSDFs under two angles, of albedos 0.2, 0.2, 0.4, 0.4 by the order in which evaluators are
/// made.
std::vector<TestCase> run_albedos(const std::vector<double>& references, double of_file,
                                  std::uint32_t seed = 1) {
  StatisticalTest test;
  test.significance = of_file;
  test.bsdfs = {{bsdf::Diffuse{}, "one", {}}, {bsdf::Diffuse{}, "two", {}}};
  test.kind = TTest{{0, 45}, references, 10000};
  FakeBackend backend;
  backend.weight = 0;
  backend.weight_step = 0.2;
  std::vector<TestCase> cases;
  run_test(test, backend, LobeSampling::visible, seed, [&](const TestCase& c) {
    cases.push_back(c);
    return true;
  });
  return cases;
}

TEST(RunTest, ReferencesGoByBsdfThenAngle) {
  const std::vector<TestCase> cases = run_albedos({0.2, 0.21, 0.41, 0.4}, 0.001);
  ASSERT_EQ(cases.size(), 4U);
  EXPECT_TRUE(cases[0].verdict.passed);
  EXPECT_FALSE(cases[1].verdict.passed);
  EXPECT_FALSE(cases[2].verdict.passed);
  EXPECT_TRUE(cases[3].verdict.passed);
  EXPECT_NE(cases[2].name.find("two"), std::string::npos);
  EXPECT_NE(cases[0].estimate.mean, cases[1].estimate.mean) << "other numbers in each case";
}

TEST(RunTest, CasesShareTheSignificance) {
  // Some reference a little off, with a p-value that one case of four may have.
  const std::vector<double> references{0.2025, 0.2, 0.4, 0.4};
  const double p = run_albedos(references, 0.01)[0].verdict.p_value;
  ASSERT_GT(p, 1e-12);
  ASSERT_LT(p, 0.1);
  EXPECT_TRUE(run_albedos(references, 2 * p)[0].verdict.passed);
  EXPECT_FALSE(run_albedos(references, 8 * p)[0].verdict.passed);
}

TEST(RunTest, ScenesAreSampledEvenlyAndIndependently) {
  StatisticalTest test;
  test.kind = TTest{{}, {0.25}, 1000};
  test.scenes.resize(1);
  Scene& scene = test.scenes[0].scene;
  scene.camera.width = 400;
  scene.camera.height = 300;
  scene.sampler = Sampler::sobol;
  scene.integrator.type = find_integrator_type("path_mis").value();
  FakeBackend backend;
  run_test(test, backend, LobeSampling::visible, 1, [](const TestCase& c) {
    EXPECT_TRUE(c.verdict.passed);
    return true;
  });
  EXPECT_GE(backend.samples, 1000U);
}

TEST(RunTest, StopsWhenTold) {
  StatisticalTest test;
  test.bsdfs = {{bsdf::Diffuse{}, "one", {}}};
  test.kind = ChiSquaredTest{4, 5, 1000, 9};
  FakeBackend backend;
  int cases = 0;
  run_test(test, backend, LobeSampling::visible, 1,
           [&cases](const TestCase&) { return ++cases < 3; });
  EXPECT_EQ(cases, 3);
}

}  // namespace

}  // namespace facet::nori
