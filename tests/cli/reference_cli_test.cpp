// The reference on the command line: `facet render --backend reference`, and `facet parity`.
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "image/files.h"

namespace facet::test {

namespace {

class ReferenceCliTest : public CliTest {
 protected:
  Image render(const std::string& name, std::vector<std::string> options) const {
    options.insert(options.begin(), {"render", "scene.xml", "--quiet", "-o", name + ".exr"});
    const Result result = run(options);
    EXPECT_EQ(result.code, 0) << result.err;
    return read_exr(folder_.file(name + ".exr"));
  }
};

/// Largest difference of two images over the largest value of the second.
double difference(const Image& a, const Image& b) {
  double most = 0;
  double largest = 0;
  for (int i = 0; i < a.width() * a.height() * 3; ++i) {
    const int x = i % a.width();
    const int y = i / a.width() % a.height();
    const int c = i / (a.width() * a.height());
    most = std::max(most, std::abs(static_cast<double>(a.at(x, y, c)) - b.at(x, y, c)));
    largest = std::max(largest, static_cast<double>(b.at(x, y, c)));
  }
  EXPECT_GT(largest, 0);
  return most / largest;
}

TEST_F(ReferenceCliTest, BothPrecisionsMakeTheKernelsImage) {
  const Image kernels = render("kernels", {});
  const Image single = render("single", {"--backend", "reference"});
  const Image twice = render("twice", {"--backend", "reference", "--precision", "double"});
  EXPECT_LT(difference(kernels, single), 1e-5);
  EXPECT_LT(difference(single, twice), 1e-5);
  EXPECT_GT(difference(single, twice), 0) << "another precision rounds otherwise";
  EXPECT_GT(difference(render("other", {"--backend", "reference", "--seed", "9"}), kernels), 0.01);
}

TEST_F(ReferenceCliTest, NeedsNoDriver) {
  const std::vector<std::string> no_driver{"VK_DRIVER_FILES=/nonexistent",
                                           "VK_ICD_FILENAMES=/nonexistent"};
  EXPECT_EQ(run({"render", "scene.xml"}, no_driver).code, 3);
  const Result result =
      run({"render", "scene.xml", "--backend", "reference", "--json", "-"}, no_driver);
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["backend"], "reference");
  EXPECT_EQ(json["device"], "CPU reference in float");
  EXPECT_GT(json["rays"]["closest"], 0);
  EXPECT_GT(json["rays"]["any"], 0);
  EXPECT_EQ(json["bad_samples"], 0);
}

TEST_F(ReferenceCliTest, OptionsThatDoNotGoTogetherAreErrors) {
  expect_failure({"render", "scene.xml", "--precision", "double"}, 2,
                 {"--precision", "--backend reference"});
  expect_failure({"render", "scene.xml", "--sampling", "uniform"}, 2,
                 {"uniform sampling", "reference"});
  expect_failure({"render", "scene.xml", "--backend", "reference", "--device", "0"}, 2,
                 {"--device", "vulkan"});
  expect_failure({"render", "scene.xml", "--backend", "reference", "--validate"}, 2,
                 {"--validate"});
  expect_failure({"render", "scene.xml", "--backend", "cuda"}, 2, {"--backend"});
  expect_failure({"parity", "scene.xml", "--sampling", "uniform"}, 2, {"--sampling"});
  expect_failure({"parity", "missing.xml"}, 2, {"missing.xml"});
  expect_failure({"parity", "scene.xml", "--json", "no/such/folder.json"}, 2, {"no such folder"});
}

TEST_F(ReferenceCliTest, UniformSamplingGivesAnotherEstimateOfTheSameImage) {
  const Image usual = render("usual", {"--spp", "256"});
  const Image uniform =
      render("uniform", {"--spp", "256", "--backend", "reference", "--sampling", "uniform"});
  EXPECT_GT(difference(uniform, usual), 1e-4);
  double means[2] = {0, 0};
  for (int i = 0; i < 256; ++i) {
    means[0] += usual.at(i % 16, i / 16, 0);
    means[1] += uniform.at(i % 16, i / 16, 0);
  }
  EXPECT_NEAR(means[1] / means[0], 1, 0.02);
}

TEST_F(ReferenceCliTest, ParityHoldsAndReports) {
  const Result result = run({"parity", "scene.xml"});
  EXPECT_EQ(result.code, 0) << result.out << result.err;
  expect_words(result.out, {"1024 samples", "equal in all bits", "diverged", "0 unexplained",
                            "same branches", "noise of 1024 samples", "parity holds"});
  const Result report =
      run({"parity", "scene.xml", "--spp", "2", "--crop", "2,3,10,9", "--quiet", "--json", "-"});
  ASSERT_EQ(report.code, 0) << report.err;
  const auto json = nlohmann::json::parse(report.out);
  EXPECT_EQ(json["samples"], 2 * 8 * 6);
  EXPECT_EQ(json["code"]["pixels"], 8 * 6);
  EXPECT_EQ(json["code"]["unexplained_samples"], 0);
  EXPECT_EQ(json["tolerance"]["relative"], 1e-5);
  EXPECT_EQ(json["passed"], true);
  EXPECT_TRUE(json["failings"].empty());
  EXPECT_LE(json["precision"]["same_branches"], json["samples"]);
}

TEST_F(ReferenceCliTest, LightsWithoutPowerAreDark) {
  folder_.write("nothing.obj", "v 0 1 0\nv 1e-25 1 0\nv 0 1 1e-25\nf 1 2 3\n");
  write_scene("scene.xml", floor() + mesh("nothing.obj", "<emitter type=\"area\"/>"));
  for (const char* integrator : {"direct_ems", "path_mis"}) {
    const Result result = run({"render", "scene.xml", "--backend", "reference", "--integrator",
                               integrator, "--json", "-"});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(nlohmann::json::parse(result.out)["error_estimate"]["relmse"], 0);
    EXPECT_EQ(run({"parity", "scene.xml", "--integrator", integrator}).code, 0);
  }
}

TEST_F(ReferenceCliTest, DevicesAreWrittenToAndNotReplaced) {
  EXPECT_EQ(run({"parity", "scene.xml", "--spp", "1", "--json", "/dev/null"}).code, 0);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_EQ(run({"parity", "scene.xml", "--spp", "1", "--json", "/dev/full"}).code, 2);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(ReferenceCliTest, OneSampleAPixelIsEnough) {
  const Result result = run({"parity", "scene.xml", "--spp", "1"});
  EXPECT_EQ(result.code, 0) << result.out;
  expect_words(result.out, {"noise of one sample a pixel is unknown"});
}

TEST_F(ReferenceCliTest, ParityOfOnePixelAndOfASceneWithoutLight) {
  EXPECT_EQ(run({"parity", "scene.xml", "--pixel", "8,8", "--sample-range", "7:8"}).code, 0);
  write_scene("dark.xml", floor());
  const Result dark = run({"parity", "dark.xml"});
  EXPECT_EQ(dark.code, 0) << dark.out;
  expect_words(dark.err, {"no emitter"});
}

}  // namespace
}  // namespace facet::test
