// facet render --error and --time: what ends a render, and what it tells of its error.
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "image/files.h"
#include "image/record.h"
#include "support/images.h"

namespace facet::test {

namespace {

using Names = std::vector<std::string>;

class GoalsCliTest : public CliTest {
 protected:
  /// Without a filter whose tails see the light so seldom that no render of this size does.
  void SetUp() override {
    CliTest::SetUp();
    folder_.write("scene.xml",
                  "<scene>" + camera("<rfilter type=\"box\"/>") +
                      R"(<sampler type="independent"/><integrator type="direct_mis"/>)" + floor() +
                      light() + "</scene>");
  }

  /// Renders the scene at 40x30 pixels to a.exr; returns the report.
  nlohmann::json render(Names options) const {
    options.insert(options.begin(), {"render", "scene.xml", "--resolution", "40x30", "--quiet",
                                     "--json", "-", "-o", "a.exr"});
    const Result result = run(options);
    EXPECT_EQ(result.code, 0) << result.err;
    messages_ = result.err;
    return nlohmann::json::parse(result.out, nullptr, false);
  }
  [[nodiscard]] Image image(const std::string& name = "a.exr") const {
    return read_exr(folder_.file(name));
  }
  /// Expects that an image is what its number of samples alone makes it.
  void expect_same_as_count(const nlohmann::json& json, Names options) const {
    const Image before = image();
    options.insert(options.end(), {"--spp", std::to_string(json["spp"].get<int>())});
    render(options);
    const Image after = image();
    for (int c = 0; c < 3; ++c)
      EXPECT_TRUE(std::equal(before.plane(c), before.plane(c) + 1200, after.plane(c)));
  }

  mutable std::string messages_;
};

TEST_F(GoalsCliTest, ARenderEndsAtTheErrorThatWasAskedFor) {
  for (const char* backend : {"vulkan", "reference"}) {
    for (const char* sampler : {"independent", "sobol"}) {
      SCOPED_TRACE(std::string(backend) + " " + sampler);
      const Names how{"--backend", backend, "--sampler", sampler};
      Names options = how;
      options.insert(options.end(), {"--error", "5%"});
      const nlohmann::json json = render(options);
      EXPECT_EQ(json["stopped_by"], "error");
      EXPECT_GT(json["spp"], 15);
      EXPECT_LE(json["error_estimate"]["relative_upper95"], 0.05);
      EXPECT_GT(json["error_estimate"]["relative"], 0.02);
      EXPECT_EQ(messages_, "");
      const Image stopped = image();
      EXPECT_EQ(*find_metadata(stopped.metadata, "facet.stoppedBy"), "error");
      expect_same_as_count(json, how);
    }
  }
}

TEST_F(GoalsCliTest, TheErrorIsTheOneThatAReferenceShows) {
  render({"--spp", "8192", "--seed", "77", "--sampler", "sobol"});
  std::filesystem::rename(folder_.file("a.exr"), folder_.file("reference.exr"));
  for (const char* sampler : {"independent", "sobol"}) {
    const nlohmann::json json = render({"--sampler", sampler, "--error", "0.04"});
    const Result compared = run({"compare", "a.exr", "reference.exr", "--json", "-"});
    const double truth = std::sqrt(nlohmann::json::parse(compared.out)["relmse"].get<double>());
    EXPECT_LE(truth, 0.04) << sampler;
    EXPECT_NEAR(json["error_estimate"]["relative"].get<double>() / truth, 1, 0.5) << sampler;
  }
}

TEST_F(GoalsCliTest, ProbesAreOfOrderedSamplersAndChangeNoImage) {
  const nlohmann::json ordered = render({"--sampler", "sobol", "--spp", "16"});
  EXPECT_EQ(ordered["error_estimate"]["replicates"], 2);
  EXPECT_GT(ordered["error_estimate"]["probes"], 200);
  const Image watched = image();
  ASSERT_EQ(run({"render", "scene.xml", "--resolution", "40x30", "--sampler", "sobol", "--spp",
                 "16", "--quiet", "-o", "b.exr"})
                .code,
            0);
  const Image unwatched = image("b.exr");
  for (int c = 0; c < 3; ++c)
    EXPECT_TRUE(std::equal(watched.plane(c), watched.plane(c) + 1200, unwatched.plane(c)));
  const nlohmann::json independent = render({"--spp", "16"});
  EXPECT_EQ(independent["error_estimate"]["replicates"], 16);
  EXPECT_EQ(independent["error_estimate"]["probes"], 0);
}

TEST_F(GoalsCliTest, ASinglePixelHasAnError) {
  for (const char* sampler : {"independent", "sobol"}) {
    const nlohmann::json json =
        render({"--pixel", "20,20", "--error", "2%", "--spp", "1000000", "--sampler", sampler});
    EXPECT_EQ(json["stopped_by"], "error") << sampler;
    EXPECT_GT(json["error_estimate"]["relative"], 0) << sampler;
  }
}

TEST_F(GoalsCliTest, SamplesAreTheMostThereMayBe) {
  const nlohmann::json json = render({"--error", "0.1%", "--spp", "32"});
  EXPECT_EQ(json["stopped_by"], "samples");
  EXPECT_EQ(json["spp"], 32);
  expect_words(messages_, {"warning", "0.1 %", "not reached", "--spp"});
}

TEST_F(GoalsCliTest, TimeEndsARenderAndIsSaid) {
  const nlohmann::json json = render({"--time", "1.5"});
  EXPECT_EQ(json["stopped_by"], "time");
  EXPECT_GT(json["spp"], 0);
  EXPECT_EQ(folder_.names(), (Names{"a.exr", "floor.obj", "light.obj", "scene.xml"}))
      << "trying how long writing takes leaves nothing behind";
  expect_same_as_count(json, {});
}

TEST_F(GoalsCliTest, TooShortATimeGivesOneSampleAndAWarning) {
  const nlohmann::json json = render({"--time", "0.001"});
  EXPECT_EQ(json["stopped_by"], "time");
  EXPECT_EQ(json["spp"], 1);
  expect_words(messages_, {"warning", "0.001 s", "not enough", "1 sample "});
}

TEST_F(GoalsCliTest, AllGoalsMayBeCombined) {
  EXPECT_EQ(render({"--error", "20%", "--time", "100", "--spp", "4096"})["stopped_by"], "error");
  EXPECT_EQ(render({"--error", "0.01%", "--time", "1", "--spp", "16777216"})["stopped_by"], "time");
  EXPECT_EQ(render({"--error", "0.01%", "--time", "100", "--spp", "16"})["stopped_by"], "samples");
}

TEST_F(GoalsCliTest, AnAdaptiveRenderEndsAtItsError) {
  for (const char* backend : {"vulkan", "reference"}) {
    const nlohmann::json json = render({"--adaptive", "--error", "5%", "--backend", backend});
    EXPECT_EQ(json["stopped_by"], "error");
    EXPECT_EQ(json["adaptive"], true);
    EXPECT_LE(json["error_estimate"]["relative_upper95"], 0.05);
    const Image adaptive = image();
    const int samples = adaptive.find_channel("samples");
    ASSERT_GE(samples, 0);
    double sum = 0;
    for (int i = 0; i < 1200; ++i) sum += static_cast<double>(adaptive.plane(samples)[i]);
    EXPECT_NEAR(sum / 1200 / json["spp"].get<double>(), 1, 0.3);
  }
}

TEST_F(GoalsCliTest, StandardErrorsAreChannels) {
  render({"--sampler", "sobol", "--spp", "64", "--aov", "error,variance"});
  const Image both = image();
  const int error = both.find_channel("error.R");
  const int variance = both.find_channel("variance.R");
  ASSERT_GE(error, 0);
  ASSERT_GE(variance, 0);
  double by_order = 0;
  double by_samples = 0;
  for (int i = 0; i < 1200; ++i) {
    by_order += std::pow(static_cast<double>(both.plane(error)[i]), 2);
    by_samples += static_cast<double>(both.plane(variance)[i]);
  }
  EXPECT_GT(by_order, 0);
  EXPECT_LT(by_order, 0.8 * by_samples) << "the sampler's order is heeded";
}

TEST_F(GoalsCliTest, WhatIsNoGoalIsSaid) {
  const auto expect_refused = [&](Names options, std::initializer_list<const char*> words) {
    options.insert(options.begin(), {"render", "scene.xml", "-o", "a.exr"});
    const Result result = run(options);
    EXPECT_EQ(result.code, 2);
    expect_words(result.err, words);
  };
  for (const char* text : {"0", "-1%", "much", "%", "nan", "1%%", "5"})
    expect_refused({"--error", text}, {"--error", text, "1%", "0.01"});
  for (const char* text : {"0", "-1", "soon", "1e99"}) expect_refused({"--time", text}, {"--time"});
  expect_refused({"--error", "1%", "--sample-range", "0:4"}, {"sample range"});
  expect_refused({"--time", "1", "--sample-range", "0:4"}, {"sample range"});
  expect_refused({"--error", "1%", "--adaptive", "--spp", "8"}, {"8 samples", "at least 16"});
}

TEST_F(GoalsCliTest, PeopleAreToldToo) {
  const Result result =
      run({"render", "scene.xml", "--resolution", "40x30", "--error", "10%", "-o", "a.exr"});
  EXPECT_EQ(result.code, 0);
  expect_words(result.err, {"estimated error", "at most", "95 % confidence", "10 %"});
}

}  // namespace

}  // namespace facet::test
