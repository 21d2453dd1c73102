// `facet bench`: what it reports, and mistakes. How fast anything is, no test says.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/browser.h"
#include "cli/program.h"

namespace facet::test {

namespace {

class BenchCliTest : public CliTest {};

/// Enough to see that everything is there.
const std::vector<std::string> quick{"--rays", "4096", "--repeats", "2", "--spp", "1"};

std::vector<std::string> bench(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "bench");
  arguments.insert(arguments.end(), quick.begin(), quick.end());
  return arguments;
}

TEST_F(BenchCliTest, RaysOfEveryKindAreCountedAndHitTheSame) {
  const Result result = run(bench({"--mesh", "1k,5000", "--json", "-"}));
  ASSERT_EQ(result.code, 0) << result.err;
  const auto report = nlohmann::json::parse(result.out);
  ASSERT_EQ(report["traversal"].size(), 6U);
  ASSERT_EQ(report["build"].size(), 2U);
  EXPECT_EQ(report["build"][1]["mesh"], "generated-5k");
  for (const auto& row : report["traversal"]) {
    EXPECT_GT(row["count"], 1000);
    EXPECT_LE(row["facet"]["min"], row["facet"]["median"]);
    EXPECT_LE(row["facet"]["median"], row["facet"]["max"]);
    EXPECT_GT(row["facet"]["min"], 0);
    if (report["yardstick"].get<std::string>().empty()) continue;
    // What differs hits edges.
    EXPECT_GE(row["equal_hits"], 0.999) << row["mesh"] << row["rays"];
    EXPECT_GT(row["ratio_embree1"], 0);
  }
  for (const auto& build : report["build"]) {
    EXPECT_GT(build["facet_sah"], 1);
    EXPECT_LT(build["facet_bytes"], 80 * build["triangles"].get<double>());
  }
}

TEST_F(BenchCliTest, ScenesAreRenderedAndTheirStagesAddUp) {
  const std::string scene = std::string(FACET_SCENES) + "/cbox/cbox_conductors_mis.xml";
  const Result result = run(bench({scene, "--json", "report.json"}));
  ASSERT_EQ(result.code, 0) << result.err;
  expect_words(result.out, {"cbox_conductors_mis: ", "camera", "diffuse", "shadow",
                            "direct_mis at 1 samples", "M samples/s", "first_bounce"});
  const auto report = nlohmann::json::parse(folder_.read("report.json"));
  ASSERT_EQ(report["render"].size(), 1U);
  const auto& render = report["render"][0];
  EXPECT_EQ(render["integrator"], "direct_mis");
  EXPECT_GT(render["samples_per_second"], 0);
  EXPECT_GT(render["rays_per_second"], render["samples_per_second"]);
  double sum = 0;
  for (const auto& share : render["stages"]) sum += share.get<double>();
  EXPECT_NEAR(sum, 1, 1e-6);
  EXPECT_EQ(report["traversal"].size(), 3U);
}

TEST_F(BenchCliTest, PageHoldsPlotsAndEveryFigureAndFetchesNothing) {
  const std::string scene = std::string(FACET_SCENES) + "/cbox/cbox_conductors_mis.xml";
  const Result result =
      run(bench({"--mesh", "1k,3k", scene, "--html", "page.html", "--json", "report.json"}));
  ASSERT_EQ(result.code, 0) << result.err;
  const std::string file = folder_.read("page.html");
  for (const char* outside : {"https:", "src=", "href=", "url(", "{{"})
    EXPECT_EQ(file.find(outside), std::string::npos) << outside;
  const auto report = nlohmann::json::parse(folder_.read("report.json"));
  const std::size_t data = file.find("id=\"data\">") + 10;
  const auto embedded =
      nlohmann::json::parse(file.substr(data, file.find("</script>", data) - data));
  for (const char* part : {"traversal", "build", "render"})
    EXPECT_EQ(embedded[part], report[part]) << part;
  const std::string browser = find_browser();
  if (browser.empty()) GTEST_SKIP() << "no chromium to look at the page with";
  const std::string dom = dump_dom(browser, folder_.file("page.html"));
  const std::string page = dom.substr(0, dom.find("<script"));
  expect_words(page, {"<!DOCTYPE html>", "Million camera rays a second",
                      "Million diffuse rays a second", "Million shadow rays a second",
                      "Seconds to build the BVH", "Million samples a second", "generated-1k",
                      "generated-3k", "cbox_conductors_mis", "direct_mis", "first_bounce, %"});
  for (const auto& row : report["traversal"]) {
    const auto& f = row["facet"];
    const std::string figure =
        fmt::format("<td class=\"number\">{:.2f} ({:.2f} to {:.2f})</td>",
                    f["median"].get<double>(), f["min"].get<double>(), f["max"].get<double>());
    EXPECT_NE(page.find(figure), std::string::npos) << figure;
  }
  for (const char* wrong : {"NaN", "Infinity", "undefined", "null"})
    EXPECT_EQ(page.find(wrong), std::string::npos) << wrong;
}

TEST_F(BenchCliTest, KernelsWithEverythingInAreLargerAndAnsweredInARowOfTheirOwn) {
  const std::string scene = std::string(FACET_SCENES) + "/cbox/cbox_conductors_mis.xml";
  const Result result = run(bench({scene, "--everything", "--json", "report.json"}));
  ASSERT_EQ(result.code, 0) << result.err;
  const auto report = nlohmann::json::parse(folder_.read("report.json"));
  ASSERT_EQ(report["render"].size(), 2U);
  EXPECT_EQ(report["render"][1]["scene"], "cbox_conductors_mis, everything in");
  EXPECT_GT(report["render"][1]["kernel_instructions"],
            1.5 * report["render"][0]["kernel_instructions"].get<double>());
  // The same paths.
  EXPECT_NEAR(report["render"][1]["rays_per_second"].get<double>() /
                  report["render"][1]["samples_per_second"].get<double>(),
              report["render"][0]["rays_per_second"].get<double>() /
                  report["render"][0]["samples_per_second"].get<double>(),
              1e-9);
}

TEST_F(BenchCliTest, GrowthIsMeasuredInPixelsSamplesAndEmitters) {
  const Result result = run({"bench", "--growth", "--quick", "--repeats", "1", "--json",
                             "report.json", "--html", "page.html"});
  ASSERT_EQ(result.code, 0) << result.err;
  expect_words(result.out,
               {"a frame's time by its pixels:", "65536", "samples a pixel:", "emitters:", "256"});
  const auto report = nlohmann::json::parse(folder_.read("report.json"));
  EXPECT_TRUE(report["traversal"].empty());
  ASSERT_EQ(report["growth"].size(), 3U);
  for (const auto& series : report["growth"]) {
    EXPECT_GE(series["points"].size(), 3U);
    double before = 0;
    for (const auto& point : series["points"]) {
      EXPECT_GT(point["number"], before);
      before = point["number"];
      EXPECT_GT(point["seconds"]["median"], 0);
    }
  }
  expect_words(folder_.read("page.html"), {"\"of\":\"emitters\"", "256"});
}

TEST_F(BenchCliTest, QuickIsLessOfEachUnlessAskedForByName) {
  const Result result =
      run({"bench", "--quick", "--repeats", "1", "--mesh", "1k", "--json", "report.json"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto report = nlohmann::json::parse(folder_.read("report.json"));
  ASSERT_GE(report["traversal"].size(), 1U);
  EXPECT_NEAR(report["traversal"][0]["count"].get<double>(), 1U << 14U, 1U << 9U);
}

TEST_F(BenchCliTest, MistakesAreNamed) {
  for (const std::string mesh : {"many", "70x", "3", "1e12"}) {
    const Result result = run(bench({"--mesh", mesh}));
    EXPECT_EQ(result.code, 2) << mesh;
    const std::string wanted = "--mesh " + mesh + ": wanted is a number of triangles";
    expect_words(result.err, {wanted.c_str()});
  }
  EXPECT_EQ(run(bench({"nowhere.xml"})).code, 2);
  EXPECT_EQ(run(bench({"--mesh", "1k", "--json", "no/such/folder.json"})).code, 2);
  EXPECT_EQ(run(bench({"--mesh", "1k", "--html", "no/such/folder.html"})).code, 2);
}

}  // namespace

}  // namespace facet::test
