// `facet tradeoff`: what it reports, that its commands do what it says, and mistakes. How fast
// anything is, no test says.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/page_checks.h"
#include "cli/program.h"
#include "image/files.h"

namespace facet::test {

namespace {

using Words = std::vector<std::string>;

class TradeoffCliTest : public CliTest {
 protected:
  /// With what is small and short; a budget of a second is spent before the first round ends.
  [[nodiscard]] nlohmann::json tradeoff(const Words& arguments,
                                        const std::string& samples = "16") const {
    Words words{"tradeoff",     "--budget", "1",      "--spp", samples,
                "--resolution", "12x10",    "--json", "t.json"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const Result result = run(words);
    EXPECT_EQ(result.code, 0) << result.err;
    out_ = result.out;
    return nlohmann::json::parse(folder_.read("t.json"));
  }

  mutable std::string out_;
};

std::set<std::string> names_of(const nlohmann::json& points) {
  std::set<std::string> names;
  for (const auto& p : points) names.insert(p["name"]);
  return names;
}

TEST_F(TradeoffCliTest, EveryChoiceHasItsPoints) {
  const auto report = tradeoff({"scene.xml"});
  for (const char* name :
       {"default", "sobol", "adaptive", "direct_ems", "direct_mats", "heuristic power",
        "area-sampling solidangle", "backend reference", "backend reference, precision double"})
    EXPECT_TRUE(names_of(report["points"]).contains(name)) << name;
  EXPECT_EQ(report["scene"], "scene.xml");
  EXPECT_GE(report["seeds"], 4);
  EXPECT_GE(report["reference"]["spp"], 256) << "whatever the budget";
  EXPECT_GT(report["reference"]["relative_error"], 0);
  for (const auto& p : report["points"]) {
    SCOPED_TRACE(p.dump());
    const bool is_reference = p["name"].get<std::string>().starts_with("backend");
    EXPECT_EQ(p["biased"], is_reference);
    EXPECT_GT(p["seconds"], 0);
    EXPECT_LE(p["interval95"][0], p["relmse"]);
    EXPECT_GT(p["relmse"], p["relmse_trimmed"]);
    // Rounding apart the reference's image is the kernels'.
    EXPECT_LT(p["bias"], 1e-3);
    if (p["name"] == "default") {
      EXPECT_DOUBLE_EQ(p["efficiency_ratio"].get<double>(), 1);
    }
  }
  expect_words(out_, {"scene.xml at 12x10", "4 renders", "efficiency", "default", "direct_mats",
                      "best: ", "facet render scene.xml"});
}

TEST_F(TradeoffCliTest, ACommandMakesTheErrorOfItsPoint) {
  // The mean over four renders of what its command makes one of: within a factor of 3 of it.
  ASSERT_EQ(run({"render", "scene.xml", "--spp", "4096", "--sampler", "sobol", "--seed", "99",
                 "--resolution", "12x10", "-o", "reference.exr", "--aov", "variance"})
                .code,
            0);
  const auto report = tradeoff({"scene.xml", "--reference", "reference.exr"});
  EXPECT_EQ(report["reference"]["file"], "reference.exr");
  EXPECT_EQ(report["reference"]["spp"], 4096);
  int tried = 0;
  for (const auto& p : report["points"]) {
    // Which choices are tried together, time decides, and with it the machine's load: some of those
    // settings have errors that four renders do not tell.
    if (p["spp"] != 16 || p["options"].size() > 2) continue;
    ++tried;
    std::string command = p["command"];
    ASSERT_TRUE(command.starts_with("facet render scene.xml ")) << command;
    command.replace(0, 5, "'" + std::string(FACET_PROGRAM) + "'");
    ASSERT_EQ(finish(start_command({"sh", "-c", command + " -o a.exr --quiet"})).code, 0)
        << command;
    const Result compared = run({"compare", "a.exr", "reference.exr", "--json", "-"});
    const auto relmse = nlohmann::json::parse(compared.out)["relmse"].get<double>();
    EXPECT_GT(relmse, p["relmse"].get<double>() / 3) << command;
    EXPECT_LT(relmse, p["relmse"].get<double>() * 3) << command;
  }
  EXPECT_GE(tried, 7);
}

TEST_F(TradeoffCliTest, WhatOthersCannotSeeIsABias) {
  // No ray hits a point light.
  write_scene("point.xml",
              floor() + light() +
                  R"(<emitter type="pointlight"><point name="position" value="0 .5 0"/>)"
                  R"(</emitter>)");
  int seen = 0;
  const auto report = tradeoff({"point.xml"}, "256");
  for (const auto& p : report["points"]) {
    if (p["name"] == "direct_mats") {
      EXPECT_TRUE(p["biased"]);
      EXPECT_GT(p["bias"], 0.1);
      ++seen;
    }
    if (p["name"] == "direct_ems") {
      EXPECT_FALSE(p["biased"]);
    }
  }
  EXPECT_EQ(seen, 3) << "of 16, 64 and 256 samples";
}

TEST_F(TradeoffCliTest, DepthIsABiasThatShrinks) {
  write_scene("path.xml", floor() + light());
  std::map<std::string, double> bias;
  const auto report = tradeoff({"path.xml", "--integrator", "path"}, "256");
  for (const auto& p : report["points"]) bias[p["name"]] = p["bias"];
  EXPECT_EQ(bias["default"], 0);
  // The floor sees itself in the lamp, the lamp itself in the floor: some percent of the light
  // each.
  EXPECT_GT(bias["max-depth 2"], 1e-3);
  EXPECT_GT(bias["max-depth 2"], bias["max-depth 3"]);
  EXPECT_GE(bias["max-depth 3"], bias["max-depth 5"]);
}

TEST_F(TradeoffCliTest, AdviceIsACommandThatKeepsItsPromise) {
  const Result result = run({"tradeoff", "scene.xml", "--budget", "1", "--spp", "16",
                             "--resolution", "12x10", "--recommend", "5%", "--quiet"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  ASSERT_TRUE(result.out.starts_with("facet render scene.xml ")) << result.out;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1);
  std::string command = result.out.substr(0, result.out.size() - 1);
  command.replace(0, 5, "'" + std::string(FACET_PROGRAM) + "'");
  ASSERT_EQ(finish(start_command({"sh", "-c", command + " --quiet --json r.json"})).code, 0);
  const auto report = nlohmann::json::parse(folder_.read("r.json"));
  EXPECT_EQ(report["stopped_by"], "error");
  EXPECT_LE(report["error_estimate"]["relative_upper95"], 0.05);
}

TEST_F(TradeoffCliTest, AllCombinationsAreMeasuredWhereAskedFor) {
  write_scene("black.xml", floor() + light());
  const auto names = names_of(
      tradeoff({"black.xml", "--integrator", "direct_ems", "--exhaustive"}, "1")["points"]);
  // By direct_mats: samplers. By direct_ems: the same, how a point of the lamp is chosen, from one
  // candidate or four. By direct_mis: heuristics as well. Adaptive sampling needs 16 samples.
  EXPECT_EQ(names.size(), 2U + 2 * 2 * 2 + 2 * 2 * 2 * 2 + 2) << "and two precisions";
  EXPECT_TRUE(names.contains("direct_mis, heuristic power, area-sampling solidangle, sobol"));
}

TEST_F(TradeoffCliTest, PageShowsEveryPointAndEveryImage) {
  const std::string browser = find_browser();
  if (browser.empty()) GTEST_SKIP() << "no chromium to look at the page with";
  const auto report = tradeoff({"scene.xml", "--html", "page.html", "--recommend", "0.05"});
  const std::string file = folder_.read("page.html");
  for (const char* outside : {"https:", "src=", "href=", "url(", "{{"})
    EXPECT_EQ(file.find(outside), std::string::npos) << outside;
  const auto page = look_at(browser, folder_.file("page.html"), FACET_TRADEOFF_PAGE_CHECKS);
  EXPECT_EQ(page["problems"], Words{});
  EXPECT_EQ(page["requests"], Words{});
  EXPECT_EQ(page["nameless"], Words{});
  EXPECT_LE(page["overflow"].get<double>(), 0);
  EXPECT_EQ(page["title"], "facet tradeoff: scene.xml");
  ASSERT_GE(page["advice"].size(), 2U);
  expect_words(page["advice"][0].get<std::string>(), {"Best: ", " times the default"});
  expect_words(page["advice"][1].get<std::string>(), {"Soonest at an error of 5 %", "--error 5%"});
  EXPECT_GE(page["plotted"].size(), report["points"].size());
  EXPECT_EQ(page["legend"][0], "Pareto front");
  EXPECT_EQ(page["legend"][1], "default");
  EXPECT_EQ(page["settings"].size(), names_of(report["points"]).size());
  ASSERT_EQ(page["commands"].size(), report["points"].size());
  for (std::size_t i = 0; i < report["points"].size(); ++i)
    EXPECT_EQ(page["commands"][i], report["points"][i]["command"]);
  EXPECT_GE(page["captions"].size(), 9U) << "the reference, and each choice alone";
  EXPECT_TRUE(page["brighter"]);
  EXPECT_EQ(page["colours"][0], 1) << "of the reference's error against itself";
  for (std::size_t i = 1; i < page["colours"].size(); ++i) EXPECT_GT(page["colours"][i], 5);
  EXPECT_EQ(page["size"], 48);
}

TEST_F(TradeoffCliTest, MistakesAreTold) {
  expect_failure({"tradeoff", "scene.xml", "--recommend", "5"}, 2, {"--recommend", "5"});
  expect_failure({"tradeoff", "scene.xml", "--reference", "no.exr"}, 2, {"no.exr"});
  Image small(3, 2, {"R", "G", "B"});
  write_exr(folder_.file("small.exr"), small);
  expect_failure({"tradeoff", "scene.xml", "--reference", "small.exr", "--resolution", "12x10"}, 2,
                 {"small.exr", "3x2", "12x10"});
  for (int c = 0; c < 3; ++c) small.at(1, 1, c) = NAN;
  write_exr(folder_.file("nan.exr"), small);
  expect_failure({"tradeoff", "scene.xml", "--reference", "nan.exr"}, 2, {"nan.exr", "finite"});
  expect_failure({"tradeoff", "scene.xml", "--reference", "small.exr", "--html", "small.exr"}, 2,
                 {"small.exr"});
  expect_failure({"tradeoff", "scene.xml", "--adaptive"}, 2, {"--adaptive"});
  expect_failure({"tradeoff", "scene.xml", "--spp", "0"}, 2, {"--spp"});
}

}  // namespace

}  // namespace facet::test
