// `facet farm-plan`: a plan from a short measurement.
#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace facet::test {

namespace {

class FarmPlanCliTest : public CliTest {};

TEST_F(FarmPlanCliTest, PlansSamples) {
  const Result result = run({"farm-plan", "scene.xml", "--spp", "4000000", "--nodes", "3",
                             "--measure", "0.3", "--longest-part", "1", "--seed", "5"});
  ASSERT_EQ(result.code, 0) << result.err;
  expect_words(result.out, {"scene.xml: 16x16 pixels, direct_mis", "measured: ", "samples/s",
                            "samples:  4000000 a pixel\n", "nodes:    3, ", "node-hours",
                            "facet render --spp=4000000 --resolution=16x16", "--seed=5",
                            "--part=I/", "--script FILE"});
}

TEST_F(FarmPlanCliTest, PlansAnErrorAndTellsItToPrograms) {
  const Result result =
      run({"farm-plan", "scene.xml", "--error", "1%", "--nodes", "2", "--measure", "3", "--json",
           "-", "--script", "it.sh", "--aov", "variance", "--crop", "0,4,16,16"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << result.out;
  EXPECT_EQ(json["nodes"], 2);
  EXPECT_GT(json["parts"], 0);
  EXPECT_GE(json["part_spp"].get<double>() * json["parts"].get<double>(),
            json["spp"].get<double>());
  const double ratio = json["measured"]["relative_upper95"].get<double>() / 1e-2;
  EXPECT_NEAR(json["spp"].get<double>(), json["measured"]["spp"].get<double>() * ratio * ratio, 1);
  EXPECT_GT(json["measured"]["part_bytes"], 1000);
  const std::string options = json["render_options"];
  EXPECT_NE(options.find(" --crop=0,4,16,16"), std::string::npos);
  EXPECT_NE(options.find(" --aov=variance"), std::string::npos);
  const std::string script = folder_.read("it.sh");
  EXPECT_NE(script.find(folder_.file("scene.xml").string()), std::string::npos) << script;
  EXPECT_EQ(finish(start_command({"sh", "-n", "it.sh"})).code, 0);
}

TEST_F(FarmPlanCliTest, OneSampleTellsOfNoError) {
  const Result result =
      run({"farm-plan", "scene.xml", "--spp", "1", "--nodes", "3", "--measure", "0.3"});
  ASSERT_EQ(result.code, 0) << result.err;
  expect_words(result.out, {"measured: 1 sample a pixel", "relative error unknown"});
}

TEST_F(FarmPlanCliTest, WhatCannotBePlannedIsRefused) {
  expect_failure({"farm-plan", "scene.xml", "--spp", "64"}, 2, {"--nodes", "needed"});
  expect_failure({"farm-plan", "scene.xml", "--nodes", "2", "--spp", "64", "--error", "1%"}, 2,
                 {"--spp", "--error"});
  expect_failure({"farm-plan", "scene.xml", "--nodes", "0"}, 2, {"--nodes"});
  expect_failure({"farm-plan", "none.xml", "--nodes", "2"}, 2, {"none.xml"});
  expect_failure({"farm-plan", "scene.xml", "--nodes", "2", "--script", "scene.xml"}, 2,
                 {"scene.xml"});
}

}  // namespace

}  // namespace facet::test
