// `facet merge`: joined parts are the whole render.
#include <nlohmann/json.hpp>

#include "cli/merge.h"
#include "parts/checksum.h"
#include "support/images.h"

namespace facet::test {

namespace {

class MergedTest : public MergeCliTest {
 protected:
  /// Renders all of the samples at once and in parts, and expects no channel to differ by more than
  /// 2 ulp.
  void expect_whole(const std::vector<std::string>& ranges, const std::string& samples,
                    Names options) const {
    SCOPED_TRACE(::testing::PrintToString(ranges));
    options.insert(options.end(), {"--spp", samples});
    Names files;
    for (const std::string& range : ranges) {
      files.push_back(range.substr(0, range.find(':')) + ".exr");
      part(files.back(), range, options);
    }
    render("whole.exr", options);
    expect_two_ulps(read("whole.exr"), merge(files));
  }

  static void expect_two_ulps(const Image& whole, const Image& merged) {
    ASSERT_EQ(merged.width(), whole.width());
    bool any = false;
    for (const char* channel : {"R", "G", "B"}) {
      const float* a = whole.plane(whole.find_channel(channel));
      const float* b = merged.plane(merged.find_channel(channel));
      for (int i = 0; i < whole.width() * whole.height(); ++i) {
        EXPECT_LE(ulps_between(a[i], b[i]), 2)
            << channel << " " << i << ": " << a[i] << " " << b[i];
        any = any || a[i] != 0;
      }
    }
    EXPECT_TRUE(any);
  }
};

TEST_F(MergedTest, PartsOfTheKernelsAreTheWhole) {
  expect_whole({"0:7", "7:64"}, "64", {});
  expect_whole({"0:1", "1:3", "3:64"}, "64", {});
  expect_whole({"0:13", "13:14", "14:31", "31:63", "63:64"}, "64", {});
}

TEST_F(MergedTest, PartsUnderOrderedSamplersAreTheWhole) {
  for (const char* backend : {"vulkan", "reference"}) {
    for (const char* sampler : {"sobol", "zsobol"}) {
      expect_whole({"0:1", "1:3", "3:37", "37:64"}, "64",
                   {"--sampler", sampler, "--backend", backend});
      EXPECT_EQ(metadata(read("whole.exr"), "facet.sampler"), sampler);
    }
  }
  EXPECT_EQ(metadata(read("whole.exr"), "facet.plannedSamples"), "64");
}

TEST_F(MergedTest, PartsOfTheReferenceAreTheWhole) {
  for (const char* precision : {"float", "double"}) {
    const Names options{"--backend", "reference", "--precision", precision};
    expect_whole({"0:7", "7:64"}, "64", options);
    expect_whole({"0:1", "1:3", "3:64"}, "64", options);
    expect_whole({"0:13", "13:14", "14:31", "31:63", "63:64"}, "64", options);
  }
}

TEST_F(MergedTest, FiftyParts) {
  const Names options{"--backend", "reference", "--resolution", "4x3"};
  std::vector<std::string> ranges;
  for (int i = 0; i < 50; ++i)
    ranges.push_back(std::to_string(3 * i) + ":" + std::to_string(3 * i + 3));
  expect_whole(ranges, "150", options);
}

TEST_F(MergedTest, TheOrderChangesNoBit) {
  const Names options{"--backend", "reference", "--aov", "variance"};
  const Names ranges{"0:5", "5:6", "6:17", "17:40"};
  Names files;
  for (const std::string& range : ranges)
    part(files.emplace_back(range.substr(0, range.find(':')) + ".exr"), range, options);
  (void)merge(files);
  const std::string first = folder_.read("merged.exr");
  for (int i = 0; i < 5; ++i) {
    std::next_permutation(files.begin(), files.end());
    std::rotate(files.begin(), files.begin() + i % 4, files.end());
    (void)merge(files);
    EXPECT_TRUE(folder_.read("merged.exr") == first) << ::testing::PrintToString(files);
  }
}

TEST_F(MergedTest, MergesAreParts) {
  const Names options{"--aov", "variance"};
  for (const char* range : {"0:3", "3:8", "8:9", "9:20"})
    part(std::string(range).substr(0, 1) + ".exr", range, options);
  render("whole.exr", {"--spp", "20"});
  (void)merge({"3.exr", "9.exr", "--allow-gaps"});
  std::filesystem::rename(folder_.file("merged.exr"), folder_.file("outer.exr"));
  EXPECT_EQ(metadata(read("outer.exr"), "facet.samples"), "3:8,9:20");
  (void)merge({"0.exr", "8.exr", "--allow-gaps"});
  std::filesystem::rename(folder_.file("merged.exr"), folder_.file("inner.exr"));
  const Image merged = merge({"outer.exr", "inner.exr", "--aov", "variance"});
  EXPECT_EQ(metadata(merged, "facet.samples"), "0:20");
  expect_two_ulps(read("whole.exr"), merged);
}

TEST_F(MergedTest, VarianceIsThatOfTheWhole) {
  part("a.exr", "0:9", {"--aov", "variance"});
  part("b.exr", "9:32", {"--aov", "variance"});
  render("whole.exr", {"--spp", "32", "--aov", "variance"});
  const Image whole = read("whole.exr");
  const Image merged = merge({"a.exr", "b.exr", "--aov", "variance"});
  for (const char* channel :
       {"variance.R", "variance.G", "variance.B", "samples", "samples.nonzero"}) {
    const float* a = whole.plane(whole.find_channel(channel));
    ASSERT_GE(merged.find_channel(channel), 0) << channel;
    const float* b = merged.plane(merged.find_channel(channel));
    for (int i = 0; i < 256; ++i) EXPECT_NEAR(a[i], b[i], 1e-6F * a[i]) << channel << " " << i;
  }
  EXPECT_EQ(merge({"a.exr", "b.exr"}).find_channel("variance.R"), -1);
  part("plain.exr", "9:32");
  expect_refusal({"a.exr", "plain.exr", "--aov", "variance"},
                 {"plain.exr: ", "squares", "--aov variance"});
  const Result result = run({"merge", "a.exr", "plain.exr", "-o", "merged.exr", "--quiet"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err.rfind("warning: plain.exr: ", 0), 0U) << result.err;
  EXPECT_EQ(read("merged.exr").find_channel("square.R"), -1);
}

TEST_F(MergedTest, CropsAndSinglePixels) {
  expect_whole({"0:3", "3:16"}, "16", {"--crop", "3,5,12,14"});
  EXPECT_EQ(read("merged.exr").window.x, 3);
  EXPECT_EQ(read("merged.exr").window.full_width, 16);
  expect_whole({"0:3", "3:16"}, "16", {"--resolution", "1x1"});
}

TEST_F(MergedTest, TheHeaderTellsOfTheWhole) {
  part("a.exr", "0:4");
  part("b.exr", "4:6");
  const Image whole = [&] {
    render("whole.exr", {"--spp", "6"});
    return read("whole.exr");
  }();
  const Image merged = merge({"b.exr", "a.exr"});
  for (const auto& [key, text] : whole.metadata) {
    if (key == "facet.seconds") continue;
    EXPECT_EQ(metadata(merged, key), text) << key;
  }
  const auto seconds = [&](const char* file) {
    return std::stod(metadata(read(file), "facet.seconds"));
  };
  EXPECT_NEAR(seconds("merged.exr"), seconds("a.exr") + seconds("b.exr"), 1e-9);
  Image elsewhere = read("b.exr");
  for (auto& [key, text] : elsewhere.metadata) {
    if (key == "facet.device") text = "another device";
  }
  add_checksum(elsewhere);
  write_exr(folder_.file("b.exr"), elsewhere);
  EXPECT_EQ(metadata(merge({"a.exr", "b.exr"}), "facet.device"),
            metadata(whole, "facet.device") + "; another device");
}

TEST_F(MergedTest, Json) {
  part("a.exr", "0:4", {"--aov", "variance", "--seed", "3"});
  part("b.exr", "6:9", {"--aov", "variance", "--seed", "3"});
  const Result result =
      run({"merge", "b.exr", "a.exr", "-o", "m.exr", "-o", "m.png", "--allow-gaps", "--json", "-"});
  EXPECT_EQ(result.code, 0);
  expect_words(result.err,
               {"scene.xml: 2 parts of 16x16 pixels, 7 samples each (0:4,6:9; missing: 4:6)",
                "wrote m.exr and m.png"});
  const auto json = nlohmann::json::parse(result.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << result.out;
  EXPECT_EQ(json["scene"], "scene.xml");
  EXPECT_EQ(json["integrator"], "path_mis");
  EXPECT_EQ(json["backend"], "vulkan");
  EXPECT_EQ(json["width"], 16);
  EXPECT_EQ(json["spp"], 7);
  EXPECT_EQ(json["seed"], 3);
  EXPECT_EQ(json["samples"], "0:4,6:9");
  EXPECT_EQ(json["missing"], "4:6");
  EXPECT_EQ(json["parts"], (nlohmann::json{"b.exr", "a.exr"}));
  EXPECT_EQ(json["output"], (nlohmann::json{"m.exr", "m.png"}));
  EXPECT_GT(json["error_estimate"]["relmse"], 0);
  EXPECT_EQ(json["heavy_tails"]["pixels"], 0);
  EXPECT_GT(json["seconds"]["render"], 0);
}

TEST_F(MergedTest, Outputs) {
  part("a.exr", "0:4");
  part("b.exr", "4:8");
  expect_failure({"merge", "a.exr", "b.exr"}, 2, {"--output", "required"});
  expect_failure({"merge", "-o", "m.exr"}, 2, {"parts", "required"});
  expect_failure({"merge", "a.exr", "b.exr", "-o", "m.jpg"}, 2, {"m.jpg", ".exr or .png"});
  expect_failure({"merge", "a.exr", "b.exr", "-o", "none/m.exr"}, 2,
                 {"none/m.exr", "no such folder"});
  expect_failure({"merge", "a.exr", "b.exr", "-o", "m.exr", "-o", "./m.exr"}, 2,
                 {"./m.exr", "twice"});
  expect_failure({"merge", "a.exr", "b.exr", "-o", "m.exr", "--json", "m.exr"}, 2,
                 {"m.exr", "twice"});
  expect_failure({"merge", "a.exr", "b.exr", "-o", "m.png", "--exposure", "nan"}, 2,
                 {"--exposure"});
  const std::string before = folder_.read("b.exr");
  expect_failure({"merge", "a.exr", "b.exr", "-o", "m.exr", "--json", "./b.exr"}, 2,
                 {"./b.exr", "read and written"});
  EXPECT_TRUE(folder_.read("b.exr") == before);
  // A sum that grows: the output may be one of the parts, which are read before it is written.
  const Image merged = merge({"a.exr", "b.exr"});
  EXPECT_EQ(run({"merge", "a.exr", "b.exr", "-o", "a.exr", "--quiet"}).code, 0);
  EXPECT_EQ(folder_.read("a.exr"), folder_.read("merged.exr"));
  EXPECT_EQ(merged.width(), 16);
}

TEST_F(MergedTest, NeedsNoDriver) {
  part("a.exr", "0:4");
  EXPECT_EQ(run({"merge", "a.exr", "-o", "m.exr"}, {"VK_ICD_FILENAMES=/nonexistent.json"}).code, 0);
}

}  // namespace

}  // namespace facet::test
