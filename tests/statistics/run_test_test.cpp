// The cases of a test file, run on a backend made here.
#include <gtest/gtest.h>

#include "support/lobe.h"

namespace facet::nori {
namespace {

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
  RenderRecord record() const override { return {}; }
  Film film() const override { return {}; }
  const RenderStatistics& statistics() const override { return statistics_; }
  RenderState state() const override { return {}; }
  bool is_good_moment() const override { return true; }
  void restore(const RenderState& /*state*/) override {}

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
  test.bsdfs = {{bsdf::Diffuse{}, "one", {}}, {bsdf::Diffuse{}, "two", {}}};
  test.kind = TTest{{0, 45}, references, 10000, of_file};
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
