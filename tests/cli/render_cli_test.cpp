// What `facet render` makes: images, reports, and their agreement with one another.
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "image/files.h"
#include "support/images.h"

namespace facet::test {

namespace {

using Names = std::vector<std::string>;

class RenderCliTest : public CliTest {
 protected:
  /// Renders the scene to name.exr with further options; standard error must stay empty.
  Image render(const std::string& name, Names options,
               const std::string& scene = "scene.xml") const {
    options.insert(options.begin(), {"render", scene, "--quiet", "-o", name + ".exr"});
    const Result result = run(options);
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, "");
    return read_exr(folder_.file(name + ".exr"));
  }
};

std::string metadata(const Image& image, const std::string& name) {
  for (const auto& [key, value] : image.metadata) {
    if (key == name) return value;
  }
  return "no " + name;
}

TEST_F(RenderCliTest, WritesExrAndPngByDefault) {
  const Result result = run({"render", "scene.xml"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out, "");
  expect_words(result.err, {"wrote scene.exr and scene.png", "16x16", "4 samples", "4 triangles"});
  EXPECT_EQ(folder_.names(),
            (Names{"floor.obj", "light.obj", "scene.exr", "scene.png", "scene.xml"}));
  EXPECT_EQ(result.err.find('\x1b'), std::string::npos) << "no bar where there is no terminal";
}

TEST_F(RenderCliTest, OptionsMayStandBeforeTheScene) {
  EXPECT_EQ(run({"render", "-o", "a.exr", "-o", "b.png", "--aov", "variance", "scene.xml"}).code,
            0);
  EXPECT_EQ(folder_.names(), (Names{"a.exr", "b.png", "floor.obj", "light.obj", "scene.xml"}));
}

TEST_F(RenderCliTest, QuietPrintsNothingAndMetadataSaysHow) {
  const Image image = render("a", {"--seed", "5"});
  EXPECT_EQ(image.width(), 16);
  EXPECT_GT(largest(image), 0.01F);
  EXPECT_EQ(metadata(image, "facet.scene"), "scene.xml");
  EXPECT_EQ(metadata(image, "facet.integrator"), "direct_mis");
  EXPECT_EQ(metadata(image, "facet.spp"), "4");
  EXPECT_EQ(metadata(image, "facet.seed"), "5");
  EXPECT_EQ(metadata(image, "facet.stoppedBy"), "samples");
}

TEST_F(RenderCliTest, OptionsOverrideTheScene) {
  const Image image = render("a", {"--spp", "2", "--resolution", "8x6", "--integrator", "normals"});
  EXPECT_EQ(image.width(), 8);
  EXPECT_EQ(image.height(), 6);
  EXPECT_EQ(metadata(image, "facet.spp"), "2");
  EXPECT_EQ(metadata(image, "facet.integrator"), "normals");
}

TEST_F(RenderCliTest, SeedsDecide) {
  const auto equal = [](const Image& a, const Image& b) {
    return std::equal(a.plane(0), a.plane(0) + 256, b.plane(0));
  };
  const Image first = render("a", {"--seed", "1"});
  EXPECT_TRUE(equal(first, render("b", {"--seed", "1"})));
  EXPECT_FALSE(equal(first, render("c", {"--seed", "2"})));
}

TEST_F(RenderCliTest, AdaptiveSamplesAreCountedInTheImage) {
  const Image image = render("a", {"--adaptive", "--spp", "32"});
  EXPECT_EQ(metadata(image, "facet.adaptive"), "true");
  EXPECT_EQ(metadata(image, "facet.stoppedBy"), "samples");
  const int samples = image.find_channel("samples");
  ASSERT_GE(samples, 0);
  double sum = 0;
  for (int i = 0; i < 256; ++i) sum += static_cast<double>(image.plane(samples)[i]);
  EXPECT_LE(sum, 28 * 256) << "four of 32 samples a pixel are the pilot's";
  EXPECT_GT(sum, 25 * 256);
  EXPECT_EQ(metadata(render("b", {"--spp", "32"}), "facet.adaptive"), "no facet.adaptive");
}

TEST_F(RenderCliTest, WhatCannotBeAdaptiveIsSaid) {
  const Result few = run({"render", "scene.xml", "--adaptive", "--spp", "15"});
  EXPECT_EQ(few.code, 2);
  expect_words(few.err, {"15 samples a pixel", "at least 16"});
  const Result part = run({"render", "scene.xml", "--adaptive", "--sample-range", "0:64"});
  EXPECT_EQ(part.code, 2);
  expect_words(part.err, {"adaptive", "sample range"});
}

TEST_F(RenderCliTest, ACropIsThatPartOfTheImage) {
  const Image whole = render("whole", {});
  const Image crop = render("crop", {"--crop", "3,5,12,14"});
  ASSERT_EQ(crop.width(), 9);
  ASSERT_EQ(crop.height(), 9);
  EXPECT_EQ(crop.window.x, 3);
  EXPECT_EQ(crop.window.y, 5);
  EXPECT_EQ(crop.window.full_width, 16);
  EXPECT_GT(largest(crop), 0);
  for (int c = 0; c < 3; ++c) {
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 9; ++x)
        EXPECT_EQ(crop.at(x, y, c), whole.at(x + 3, y + 5, c)) << x << " " << y;
    }
  }
}

TEST_F(RenderCliTest, APixelIsThatOfTheImage) {
  const Image whole = render("whole", {});
  const Result result = run({"render", "scene.xml", "--quiet", "--pixel", "8,10"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "");
  float r = -1;
  float g = -1;
  float b = -1;
  ASSERT_EQ(std::sscanf(result.out.c_str(), "pixel 8,10: %f %f %f\n", &r, &g, &b), 3) << result.out;
  EXPECT_GT(r, 0);
  EXPECT_EQ(r, whole.at(8, 10, whole.find_channel("R")));
  EXPECT_EQ(g, whole.at(8, 10, whole.find_channel("G")));
  EXPECT_EQ(b, whole.at(8, 10, whole.find_channel("B")));
  EXPECT_FALSE(std::filesystem::exists(folder_.file("scene.exr"))) << "no file was asked for";
}

TEST_F(RenderCliTest, SampleRangesJoinToTheWhole) {
  const Image whole = render("whole", {});
  const Image first = render("first", {"--sample-range", "0:1"});
  const Image rest = render("rest", {"--sample-range", "1:4"});
  EXPECT_EQ(metadata(rest, "facet.samples"), "1:4");
  EXPECT_EQ(metadata(rest, "facet.spp"), "3");
  for (int i = 0; i < 256; ++i) {
    const float joined = (first.at(i % 16, i / 16, 0) + 3 * rest.at(i % 16, i / 16, 0)) / 4;
    EXPECT_NEAR(joined, whole.at(i % 16, i / 16, 0), 1e-6F * (1 + joined)) << i;
  }
}

TEST_F(RenderCliTest, VarianceChannels) {
  const Image image = render("a", {"--aov", "variance"});
  for (const char* name : {"R", "G", "B", "variance.R", "variance.G", "variance.B", "samples"})
    EXPECT_GE(image.find_channel(name), 0) << name;
  EXPECT_EQ(image.at(0, 0, image.find_channel("samples")), 4);
}

TEST_F(RenderCliTest, JsonHasEveryKeyAndStandardOutputNothingElse) {
  const Result result = run({"render", "scene.xml", "-o", "a.exr", "--json", "-"});
  EXPECT_EQ(result.code, 0);
  const auto json = nlohmann::json::parse(result.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << result.out;
  for (const char* key :
       {"scene", "device", "driver", "backend", "integrator", "sampler", "features", "output"})
    EXPECT_FALSE(json.value(key, nlohmann::json()).empty()) << key;
  for (const char* key : {"width", "height", "spp", "seed", "triangles", "emitters",
                          "samples_per_second", "rays_per_second", "bad_samples", "bound_hits"})
    EXPECT_TRUE(json.value(key, nlohmann::json()).is_number()) << key;
  for (const char* path :
       {"/seconds/load", "/seconds/bvh", "/seconds/compile", "/seconds/render", "/seconds/write",
        "/seconds/total", "/rays/closest", "/rays/any", "/error_estimate/relmse",
        "/error_estimate/relative", "/heavy_tails/pixels", "/heavy_tails/variance_share",
        "/memory/device_bytes", "/memory/host_peak_bytes"})
    EXPECT_TRUE(json.value(nlohmann::json::json_pointer(path), nlohmann::json()).is_number())
        << path;
}

TEST_F(RenderCliTest, JsonTellsTheTruth) {
  const Result result = run({"render", "scene.xml", "-o", "a.exr", "-o", "b.png", "--json",
                             "a.json", "--quiet", "--seed", "3"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out + result.err, "");
  const auto json = nlohmann::json::parse(folder_.read("a.json"), nullptr, false);
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json["scene"], "scene.xml");
  EXPECT_EQ(json["integrator"], "direct_mis");
  EXPECT_EQ(json["width"], 16);
  EXPECT_EQ(json["spp"], 4);
  EXPECT_EQ(json["seed"], 3);
  EXPECT_EQ(json["triangles"], 4);
  EXPECT_EQ(json["emitters"], 1);
  EXPECT_EQ(json["output"], (nlohmann::json{"a.exr", "b.png"}));
  EXPECT_EQ(json["bad_samples"], 0);
  EXPECT_EQ(json["bound_hits"], 0);
  EXPECT_GE(json["rays"]["closest"], 1024);
  EXPECT_GT(json["error_estimate"]["relmse"], 0);
  EXPECT_GE(json["seconds"]["total"], json["seconds"]["render"]);
}

TEST_F(RenderCliTest, JsonAndPixelTogetherStayParsable) {
  const Result result = run({"render", "scene.xml", "--quiet", "--pixel", "8,10", "--json", "-"});
  EXPECT_EQ(result.code, 0);
  EXPECT_FALSE(nlohmann::json::parse(result.out, nullptr, false).is_discarded()) << result.out;
}

TEST_F(RenderCliTest, NamesThatAreNotUtf8) {
  std::filesystem::copy(folder_.file("scene.xml"), folder_.file("sc\xe8ne.xml"));
  const Result result = run({"render", "sc\xe8ne.xml", "-o", "a.exr", "--quiet", "--json", "-"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_FALSE(nlohmann::json::parse(result.out, nullptr, false).is_discarded()) << result.out;
}

TEST_F(RenderCliTest, OverflowIsNeverSilent) {
  write_scene(
      "bright.xml",
      floor() + mesh("light.obj",
                     "<emitter type=\"area\"><color name=\"radiance\" value=\"1e38\"/></emitter>"));
  const Result result = run({"render", "bright.xml", "--quiet", "--spp", "64"});
  if (result.code != 0 || !result.err.empty()) return;
  const Image image = read_exr(folder_.file("bright.exr"));
  for (int i = 0; i < 256; ++i) ASSERT_TRUE(std::isfinite(image.at(i % 16, i / 16, 0))) << i;
}

TEST_F(RenderCliTest, AnInterruptWritesTheImageSoFar) {
  folder_.write("a.exr", "old");
  // A signal before rendering has begun ends the program at once; then it comes later next time.
  Result result;
  for (int delay = 400; delay < 20000; delay *= 2) {
    const pid_t child = start({"render", "scene.xml", "--spp", "1000000000", "-o", "a.exr"});
    std::this_thread::sleep_for(std::chrono::milliseconds(delay));
    ASSERT_EQ(::kill(child, SIGINT), 0);
    result = finish(child);
    if (result.code != 1000 + SIGINT) break;
    EXPECT_EQ(folder_.read("a.exr"), "old");
  }
  EXPECT_EQ(result.code, 130) << result.err;
  expect_words(result.err, {"interrupted", "wrote a.exr"});
  const Image image = read_exr(folder_.file("a.exr"));
  EXPECT_EQ(image.width(), 16);
  EXPECT_GT(largest(image), 0.01F);
  EXPECT_EQ(metadata(image, "facet.stoppedBy"), "interrupt");
}

TEST_F(RenderCliTest, ValidationLayersAreSilent) {
  const Result result = run({"render", "scene.xml", "-o", "a.exr", "--validate", "--quiet"});
  if (result.err.find("vulkan-validationlayers") != std::string::npos) GTEST_SKIP() << result.err;
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
}

TEST_F(RenderCliTest, WritesTheDefaultIntoAFolder) {
  std::filesystem::create_directory(folder_.file("images"));
  ASSERT_EQ(run({"render", "scene.xml", "-o", "images"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_.file("images/scene.exr")));
  EXPECT_TRUE(std::filesystem::exists(folder_.file("images/scene.png")));
  ASSERT_EQ(run({"render", "scene.xml", "-o", "images/", "--part", "1/2"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_.file("images/scene_part_1_of_2.exr")));
  const Result none = run({"render", "scene.xml", "-o", "none/"});
  EXPECT_EQ(none.code, 2);
  expect_words(none.err, {"none/scene.exr", "no such folder"});
}

}  // namespace

}  // namespace facet::test
