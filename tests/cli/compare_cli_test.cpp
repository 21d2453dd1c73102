// What `facet compare` measures, prints and returns.
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "image/files.h"

namespace facet::test {

namespace {

using Names = std::vector<std::string>;

class CompareCliTest : public CliTest {
 protected:
  /// A 4x3 image of one gray, but for its first pixel.
  static Image image(float first, float rest = 0.5F) {
    Image result(4, 3, {"R", "G", "B"});
    for (int c = 0; c < 3; ++c) {
      std::fill_n(result.plane(c), 12, rest);
      result.at(0, 0, c) = first;
    }
    return result;
  }
  void write(const std::string& name, const Image& image) const {
    if (name.ends_with(".png")) return write_png(folder_.file(name), image, 0);
    write_exr(folder_.file(name), image);
  }

  /// The report of a comparison with the exit code expected.
  [[nodiscard]] nlohmann::json report(Names options, int code = 0) const {
    options.insert(options.begin(), "compare");
    options.insert(options.end(), {"--json", "-"});
    const Result result = run(options);
    EXPECT_EQ(result.code, code) << result.err;
    return nlohmann::json::parse(result.out);
  }

  /// Expects exit code 1, and one line on standard error that holds the words.
  void expect_violation(Names options, std::initializer_list<const char*> words) const {
    options.insert(options.begin(), {"compare", "a.exr", "b.exr"});
    SCOPED_TRACE(::testing::PrintToString(options));
    const Result result = run(options);
    EXPECT_EQ(result.code, 1);
    expect_words(result.err, words);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    expect_words(result.out, {"relMSE", "FLIP"});
  }
};

TEST_F(CompareCliTest, HelpNamesEveryOption) {
  const Result result = run({"compare", "--help"});
  EXPECT_EQ(result.code, 0);
  expect_words(result.out,
               {"--max-mean", "--max-abs", "--max-rmse", "--max-relmse", "--max-flip",
                "--max-hdrflip", "--min-identical", "--max-beyond", "--z-test", "--tolerance",
                "--significance", "--ppd", "--trim", "--json", "--html"});
}

TEST_F(CompareCliTest, PrintsATable) {
  write("a.exr", image(1));
  write("b.exr", image(0.5F));
  const Result result = run({"compare", "a.exr", "b.exr"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "");
  expect_words(result.out,
               {"a.exr against the reference b.exr, 4x3 pixels", "mean ratio",
                "mean luminance 0.5417 of 0.5; ratios of R, G, B: 1.083, 1.083, 1.083", "max abs",
                "at pixel (0, 0)", "RMSE", "relMSE, trimmed", "FLIP", "HDR-FLIP", "bit-identical",
                "91.67 % (11 of 12 pixels)", "beyond tolerance"});
  EXPECT_EQ(result.out.find("z-test"), std::string::npos);
  EXPECT_EQ(folder_.names(), (Names{"a.exr", "b.exr", "floor.obj", "light.obj", "scene.xml"}));
}

TEST_F(CompareCliTest, ReportsAsJson) {
  Image a = image(1);
  Image b = image(0.5F);
  a.window = b.window = {10, 20, 100, 100};
  write("a.exr", a);
  write("b.exr", b);
  const nlohmann::json json = report({"a.exr", "b.exr", "--max-rmse", "1"});
  EXPECT_EQ(json["image"], "a.exr");
  EXPECT_EQ(json["reference"], "b.exr");
  EXPECT_EQ(json["width"], 4);
  EXPECT_EQ(json["height"], 3);
  EXPECT_EQ(json["max_abs"], 0.5);
  // One pixel of twelve is 1 instead of 0.5.
  EXPECT_NEAR(json["mean_ratio"].get<double>(), 13.0 / 12, 1e-12);
  EXPECT_NEAR(json["mean"]["image"][1].get<double>(), 6.5 / 12, 1e-12);
  EXPECT_EQ(json["mean"]["reference"], (std::vector<double>(3, 0.5)));
  EXPECT_EQ(json["max_abs_pixel"], (std::vector<int>{10, 20}));
  EXPECT_NEAR(json["rmse"].get<double>(), std::sqrt(0.25 / 12), 1e-12);
  EXPECT_NEAR(json["relmse"].get<double>(), 0.25 / (0.25 + 0.25e-4) / 12, 1e-12);
  EXPECT_EQ(json["relmse_trimmed"], 0);
  EXPECT_EQ(json["trimmed_pixels"], 1);
  EXPECT_EQ(json["identical"]["pixels"], 11);
  EXPECT_EQ(json["beyond"]["pixels"], 1);
  EXPECT_EQ(json["beyond"]["tolerance"], 1e-3);
  EXPECT_EQ(json["non_finite"]["either"], 0);
  EXPECT_GT(json["flip"]["mean"].get<double>(), 0);
  EXPECT_GT(json["hdr_flip"]["mean"].get<double>(), 0);
  EXPECT_GE(json["hdr_flip"]["exposures"].get<int>(), 2);
  EXPECT_TRUE(json["z_test"].is_null());
  EXPECT_TRUE(json["violations"].empty());
  EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--json", "report.json"}).code, 0);
  EXPECT_EQ(nlohmann::json::parse(folder_.read("report.json"))["rmse"], json["rmse"]);
}

TEST_F(CompareCliTest, EqualImagesPassTheStrictestThresholds) {
  write("a.exr", image(2));
  const Result result =
      run({"compare", "a.exr",           "a.exr", "--max-abs",   "0", "--max-rmse",
           "0",       "--max-relmse",    "0",     "--max-flip",  "0", "--max-hdrflip",
           "0",       "--min-identical", "1",     "--tolerance", "0", "--max-beyond",
           "0",       "--max-mean",      "0"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "");
}

TEST_F(CompareCliTest, EachThresholdCanFail) {
  write("a.exr", image(1));
  write("b.exr", image(0.5F));
  expect_violation({"--max-abs", "0.4"}, {"max abs is 0.5", "--max-abs 0.4"});
  expect_violation({"--max-rmse", "0.1"}, {"RMSE is 0.144338", "--max-rmse 0.1"});
  expect_violation({"--max-relmse", "0.01"}, {"relMSE is 0.083325", "--max-relmse 0.01"});
  expect_violation({"--max-flip", "1e-9"}, {"FLIP is ", "--max-flip 1e-09"});
  expect_violation({"--max-hdrflip", "1e-9"}, {"HDR-FLIP is ", "--max-hdrflip 1e-09"});
  expect_violation({"--min-identical", "0.95"},
                   {"bit-identical share is 0.916667", "--min-identical 0.95"});
  expect_violation({"--max-mean", "0.08"}, {"mean ratio", "0.0833333", "--max-mean 0.08"});
  expect_violation({"--max-beyond", "0.05"}, {"0.0833333", "--max-beyond 0.05"});
  EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--max-abs", "0.5", "--max-rmse", "0.2",
                 "--max-relmse", "0.1", "--max-flip", "1", "--max-hdrflip", "1", "--min-identical",
                 "0.9", "--max-beyond", "0.1", "--max-mean", "0.084"})
                .code,
            0);
  EXPECT_EQ(
      report({"a.exr", "b.exr", "--max-abs", "0.1", "--max-rmse", "0"}, 1)["violations"].size(),
      2U);
}

TEST_F(CompareCliTest, TrimmingAndToleranceDecide) {
  write("a.exr", image(1));
  write("b.exr", image(0.5F));
  EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--max-relmse", "0", "--trim"}).code, 0);
  EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--max-beyond", "0", "--tolerance", "1"}).code, 0);
}

TEST_F(CompareCliTest, NothingPassesThatIsNotFinite) {
  for (const float bad : {NAN, INFINITY}) {
    write("a.exr", image(bad));
    write("b.exr", image(bad));
    for (const Names& threshold :
         {Names{"--max-rmse", "100"}, Names{"--min-identical", "0"}, Names{"--max-beyond", "1"},
          Names{"--max-flip", "1"}, Names{"--max-mean", "1"}}) {
      Names arguments{"compare", "a.exr", "b.exr"};
      arguments.insert(arguments.end(), threshold.begin(), threshold.end());
      const Result result = run(arguments);
      EXPECT_EQ(result.code, 1) << threshold[0];
      expect_words(result.err, {"pixels that are not finite: 1, which no threshold lets pass"});
    }
    const Result plain = run({"compare", "a.exr", "b.exr"});
    EXPECT_EQ(plain.code, 0);
    expect_words(plain.err, {"warning: pixels that are not finite: 1 in a.exr, 1 in b.exr"});
    EXPECT_EQ(report({"a.exr", "b.exr"})["non_finite"]["either"], 1);
  }
  write("a.exr", image(NAN, NAN));
  EXPECT_TRUE(report({"a.exr", "a.exr"})["rmse"].is_null());
}

TEST_F(CompareCliTest, PngsAreComparedAsLinear) {
  write("a.png", image(1));
  write("b.exr", image(1));
  // 0.5 is encoded as 188, which is 0.502886.
  EXPECT_NEAR(report({"a.png", "b.exr"})["max_abs"].get<double>(), 0.002886, 1e-5);
  Image crop = image(1);
  crop.window = {4, 4, 16, 16};
  write("crop.exr", crop);
  EXPECT_EQ(run({"compare", "a.png", "crop.exr", "--max-abs", "0.01"}).code, 0);
}

TEST_F(CompareCliTest, WritesASelfContainedPage) {
  write("a.png", image(1));
  write("b.exr", image(0.5F));
  folder_.write("page.html", "old");
  const Result result = run({"compare", "a.png", "b.exr", "--html", "page.html", "--json", "-"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(nlohmann::json::parse(result.out)["width"], 4);
  const std::string page = folder_.read("page.html");
  expect_words(page, {"<!DOCTYPE html>", "\"image\":\"a.png\"", "\"reference\":\"b.exr\"",
                      "HDR-FLIP", "\"origins\":[]", "\"image_command\":\"\"", "</html>"});
  for (const char* reference : {"src=", "href=", "url(", "https://", "@import", "{{"})
    EXPECT_EQ(page.find(reference), std::string::npos) << reference;
  // Equal images and images without a finite pixel have a page too.
  write("nan.exr", image(NAN, NAN));
  EXPECT_EQ(run({"compare", "b.exr", "b.exr", "--html", "page.html"}).code, 0);
  expect_words(folder_.read("page.html"), {"\"worst\":[]"});
  EXPECT_EQ(run({"compare", "nan.exr", "b.exr", "--html", "page.html"}).code, 0);
  expect_words(folder_.read("page.html"), {"12 of 12 pixels are not finite"});
}

TEST_F(CompareCliTest, BadInput) {
  write("a.exr", image(1));
  write("b.exr", Image(3, 4, {"R", "G", "B"}));
  write("depth.exr", Image(4, 3, {"Z"}));
  Image crop = image(1);
  crop.window = {4, 4, 16, 16};
  write("crop.exr", crop);
  folder_.write("text.exr", "no image");
  expect_failure({"compare", "a.exr", "b.exr"}, 2, {"a.exr is 4x3", "b.exr is 3x4"});
  expect_failure({"compare", "a.exr", "crop.exr"}, 2,
                 {"a.exr is 4x3", "crop.exr is 4x3 at (4, 4) of 16x16"});
  expect_failure({"compare", "a.exr", "depth.exr"}, 2, {"depth.exr", "no channel R"});
  expect_failure({"compare", "a.exr", "none.exr"}, 2, {"none.exr", "no such file"});
  expect_failure({"compare", "text.exr", "a.exr"}, 2,
                 {"text.exr", "not an OpenEXR, PNG, JPEG or HDR image"});
  expect_failure({"compare", "a.exr", "scene.xml"}, 2,
                 {"scene.xml", "not an OpenEXR, PNG, JPEG or HDR image"});
  expect_failure({"compare", "a.exr"}, 2, {"reference", "required"});
  expect_failure({"compare", "a.exr", "a.exr", "--z-test"}, 2, {"a.exr", "--aov variance"});
}

TEST_F(CompareCliTest, BadOptions) {
  write("a.exr", image(1));
  for (const char* option :
       {"--max-mean", "--max-abs", "--max-rmse", "--max-relmse", "--max-flip", "--max-hdrflip",
        "--min-identical", "--max-beyond", "--tolerance", "--significance", "--ppd"}) {
    for (const char* value : {"-1", "nan", "inf", "x", ""})
      expect_failure({"compare", "a.exr", "a.exr", std::string(option) + "=" + value}, 2, {option});
  }
  expect_failure({"compare", "a.exr", "a.exr", "--min-identical", "1.5"}, 2,
                 {"--min-identical", "number from 0 to 1"});
  expect_failure({"compare", "a.exr", "a.exr", "--json", "a.exr"}, 2,
                 {"a.exr", "read and written"});
  expect_failure({"compare", "a.exr", "a.exr", "--json", "c", "--html", "./c"}, 2,
                 {"written twice"});
  expect_failure({"compare", "a.exr", "a.exr", "--html", "none/page.html"}, 2,
                 {"none/page.html", "no such folder"});
  expect_failure({"compare", "a.exr", "a.exr", "--html", "-"}, 2, {"--html needs a file"});
  EXPECT_EQ(read_exr(folder_.file("a.exr")).width(), 4);
}

TEST_F(CompareCliTest, RendersPassAndFailTheZTest) {
  write_scene(
      "dark.xml",
      floor() + mesh("light.obj",
                     "<emitter type=\"area\"><color name=\"radiance\" value=\"0.9\"/></emitter>"));
  const auto render = [&](const char* scene, const char* name, const char* seed) {
    const Result result = run({"render", scene, "--quiet", "--spp", "256", "--aov", "variance",
                               "--seed", seed, "-o", name});
    ASSERT_EQ(result.code, 0) << result.err;
  };
  render("scene.xml", "a.exr", "1");
  render("scene.xml", "b.exr", "2");
  render("dark.xml", "dark.exr", "3");
  const nlohmann::json json = report({"a.exr", "b.exr", "--z-test"});
  EXPECT_EQ(json["z_test"]["passed"], true);
  EXPECT_GT(json["z_test"]["tests"].get<int>(), 0);
  const Result different = run({"compare", "dark.exr", "b.exr", "--z-test"});
  EXPECT_EQ(different.code, 1);
  expect_words(different.err, {"--z-test: largest z",
                               "different scenes: dark.xml in dark.exr, scene.xml in b.exr"});
  EXPECT_EQ(run({"compare", "dark.exr", "b.exr"}).code, 0) << "without a threshold nothing fails";
  expect_words(run({"compare", "a.exr", "a.exr", "--z-test"}).err, {"share samples"});
}

TEST_F(CompareCliTest, AVarianceThatOverflowedCannotPass) {
  Image noisy(
      4, 3,
      {"R", "G", "B", "variance.R", "variance.G", "variance.B", "samples", "samples.nonzero"});
  for (int i = 0; i < 12; ++i) {
    for (int c = 0; c < 6; ++c) noisy.at(i % 4, i / 4, c) = c < 3 ? 1.F : 1e-4F;
    noisy.at(i % 4, i / 4, 6) = noisy.at(i % 4, i / 4, 7) = 1000;
  }
  write("a.exr", noisy);
  EXPECT_EQ(run({"compare", "a.exr", "a.exr", "--z-test"}).code, 0);
  noisy.at(1, 1, 4) = INFINITY;
  write("b.exr", noisy);
  const Result result = run({"compare", "b.exr", "a.exr", "--z-test"});
  EXPECT_EQ(result.code, 1);
  expect_words(result.err, {"variance is not finite: 1"});
}

}  // namespace

}  // namespace facet::test
