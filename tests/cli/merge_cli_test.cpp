// `facet merge`: joined parts are the whole render, and what does not belong together is refused.
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "image/files.h"
#include "image/part.h"

namespace facet::test {

namespace {

using Names = std::vector<std::string>;

/// Steps from one float to the other, through all floats between.
std::int64_t ulps_between(float a, float b) {
  const auto rank = [](float x) {
    const auto bits = std::bit_cast<std::int32_t>(x);
    return bits < 0 ? -std::int64_t{bits & 0x7fffffff} : std::int64_t{bits};
  };
  return std::abs(rank(a) - rank(b));
}

class MergeCliTest : public CliTest {
 protected:
  static std::string with_filter(const std::string& filter) {
    return R"(<scene><camera type="perspective"><integer name="width" value="16"/><integer name="height" value="16"/>
<transform name="toWorld"><lookat origin="0.1 0.8 -4" target="0 0.4 0" up="0 1 0"/></transform>)" +
           filter + "</camera>\n<integrator type=\"path_mis\"/>\n" +
           mesh("floor.obj", "<bsdf type=\"roughconductor\"><float name=\"alpha\" value=\"0.3\"/></bsdf>") +
           light() + "</scene>\n";
  }

  void SetUp() override {
    CliTest::SetUp();
    folder_.write("scene.xml", with_filter("<rfilter type=\"mitchell\"/>"));
  }

  /// Renders a part of the samples.
  void part(const std::string& name, const std::string& range, Names options = {}) const {
    options.insert(options.end(), {"--sample-range", range});
    render(name, options);
  }
  void render(const std::string& name, Names options) const {
    options.insert(options.begin(), {"render", "--quiet", "-o", name});
    if (std::find(options.begin(), options.end(), "other.xml") == options.end())
      options.emplace_back("scene.xml");
    const Result result = run(options);
    ASSERT_EQ(result.code, 0) << result.err;
    ASSERT_EQ(result.err, "");
  }
  Image merge(Names options) const {
    options.insert(options.begin(), {"merge", "--quiet", "-o", "merged.exr"});
    const Result result = run(options);
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.out + result.err, "");
    return read("merged.exr");
  }
  [[nodiscard]] Image read(const std::string& name) const { return read_exr(folder_.file(name)); }

  void expect_refusal(const Names& parts, std::initializer_list<const char*> words) const {
    Names options{"merge", "-o", "none.exr"};
    options.insert(options.end(), parts.begin(), parts.end());
    expect_failure(options, 2, words);
    EXPECT_FALSE(std::filesystem::exists(folder_.file("none.exr")));
  }

  /// Renders all of the samples at once and in parts, and expects no channel to differ by more than 2 ulp.
  void expect_whole(const std::vector<std::string>& ranges, const std::string& samples,
                    const Names& options) const {
    SCOPED_TRACE(::testing::PrintToString(ranges));
    Names files;
    for (const std::string& range : ranges) {
      files.push_back(range.substr(0, range.find(':')) + ".exr");
      part(files.back(), range, options);
    }
    Names whole = options;
    whole.insert(whole.end(), {"--spp", samples});
    render("whole.exr", whole);
    expect_two_ulps(read("whole.exr"), merge(files));
  }

  static void expect_two_ulps(const Image& whole, const Image& merged) {
    ASSERT_EQ(merged.width(), whole.width());
    bool any = false;
    for (const char* channel : {"R", "G", "B"}) {
      const float* a = whole.plane(whole.find_channel(channel));
      const float* b = merged.plane(merged.find_channel(channel));
      for (int i = 0; i < whole.width() * whole.height(); ++i) {
        EXPECT_LE(ulps_between(a[i], b[i]), 2) << channel << " " << i << ": " << a[i] << " " << b[i];
        any = any || a[i] != 0;
      }
    }
    EXPECT_TRUE(any);
  }
};

std::string metadata(const Image& image, const std::string& name) {
  const std::string* text = find_metadata(image.metadata, name);
  return text == nullptr ? "no " + name : *text;
}

TEST_F(MergeCliTest, PartsOfTheKernelsAreTheWhole) {
  expect_whole({"0:7", "7:64"}, "64", {});
  expect_whole({"0:1", "1:3", "3:64"}, "64", {});
  expect_whole({"0:13", "13:14", "14:31", "31:63", "63:64"}, "64", {});
}

TEST_F(MergeCliTest, PartsOfTheReferenceAreTheWhole) {
  for (const char* precision : {"float", "double"}) {
    const Names options{"--backend", "reference", "--precision", precision};
    expect_whole({"0:7", "7:64"}, "64", options);
    expect_whole({"0:1", "1:3", "3:64"}, "64", options);
    expect_whole({"0:13", "13:14", "14:31", "31:63", "63:64"}, "64", options);
  }
}

TEST_F(MergeCliTest, FiftyParts) {
  const Names options{"--backend", "reference", "--resolution", "4x3"};
  std::vector<std::string> ranges;
  for (int i = 0; i < 50; ++i) ranges.push_back(std::to_string(3 * i) + ":" + std::to_string(3 * i + 3));
  expect_whole(ranges, "150", options);
}

TEST_F(MergeCliTest, TheOrderChangesNoBit) {
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

TEST_F(MergeCliTest, MergesAreParts) {
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

TEST_F(MergeCliTest, VarianceIsThatOfTheWhole) {
  part("a.exr", "0:9", {"--aov", "variance"});
  part("b.exr", "9:32", {"--aov", "variance"});
  render("whole.exr", {"--spp", "32", "--aov", "variance"});
  const Image whole = read("whole.exr");
  const Image merged = merge({"a.exr", "b.exr", "--aov", "variance"});
  for (const char* channel : {"variance.R", "variance.G", "variance.B", "samples", "samples.nonzero"}) {
    const float* a = whole.plane(whole.find_channel(channel));
    ASSERT_GE(merged.find_channel(channel), 0) << channel;
    const float* b = merged.plane(merged.find_channel(channel));
    for (int i = 0; i < 256; ++i) EXPECT_NEAR(a[i], b[i], 1e-6F * a[i]) << channel << " " << i;
  }
  EXPECT_EQ(merge({"a.exr", "b.exr"}).find_channel("variance.R"), -1);
  part("plain.exr", "9:32");
  expect_refusal({"a.exr", "plain.exr", "--aov", "variance"}, {"plain.exr: ", "squares", "--aov variance"});
  EXPECT_EQ(merge({"a.exr", "plain.exr"}).find_channel("square.R"), -1);
}

TEST_F(MergeCliTest, CropsAndSinglePixels) {
  expect_whole({"0:3", "3:16"}, "16", {"--crop", "3,5,12,14"});
  EXPECT_EQ(read("merged.exr").window.x, 3);
  EXPECT_EQ(read("merged.exr").window.full_width, 16);
  expect_whole({"0:3", "3:16"}, "16", {"--resolution", "1x1"});
}

TEST_F(MergeCliTest, TheHeaderTellsOfTheWhole) {
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
  const auto seconds = [&](const char* file) { return std::stod(metadata(read(file), "facet.seconds")); };
  EXPECT_NEAR(seconds("merged.exr"), seconds("a.exr") + seconds("b.exr"), 1e-9);
  Image elsewhere = read("b.exr");
  for (auto& [key, text] : elsewhere.metadata) {
    if (key == "facet.device") text = "another device";
  }
  write_exr(folder_.file("b.exr"), elsewhere);
  EXPECT_EQ(metadata(merge({"a.exr", "b.exr"}), "facet.device"),
            metadata(whole, "facet.device") + "; another device");
}

TEST_F(MergeCliTest, Json) {
  part("a.exr", "0:4", {"--aov", "variance", "--seed", "3"});
  part("b.exr", "6:9", {"--aov", "variance", "--seed", "3"});
  const Result result =
      run({"merge", "b.exr", "a.exr", "-o", "m.exr", "-o", "m.png", "--allow-gaps", "--json", "-"});
  EXPECT_EQ(result.code, 0);
  expect_words(result.err, {"scene.xml: 2 parts of 16x16 pixels, 7 samples each (0:4,6:9; missing: 4:6)",
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
  EXPECT_GT(json["seconds"]["render"], 0);
}

TEST_F(MergeCliTest, PartsOfDifferentRendersAreRefused) {
  part("a.exr", "0:2");
  const std::vector<std::pair<Names, Names>> differences{
      {{"--seed", "1"}, {"seed is 1", "is 0"}},
      {{"--integrator", "path_mats"}, {"integrator is path_mats", "is path_mis"}},
      {{"--max-depth", "3"}, {"maximum depth is 3", "is -1"}},
      {{"--heuristic", "power"}, {"heuristic is power", "is balance"}},
      {{"--emitter-selection", "uniform"}, {"emitter selection is uniform", "is power"}},
      {{"--sampling", "ndf"}, {"lobe sampling is ndf", "is visible"}},
      {{"--backend", "reference"}, {"backend is reference", "is vulkan"}},
      {{"--resolution", "8x16"}, {"image is 8x16", "is 16x16"}},
      {{"--crop", "1,2,16,16"}, {"crop is 1,2,16,16", "is 0,0,16,16"}}};
  for (const auto& [options, words] : differences) {
    part("b.exr", "2:4", options);
    for (const std::string& word : words)
      expect_refusal({"a.exr", "b.exr"}, {"b.exr: ", word.c_str(), "a.exr"});
  }
  part("b.exr", "2:4", {"--backend", "reference"});
  part("c.exr", "4:5", {"--backend", "reference", "--precision", "double"});
  expect_refusal({"b.exr", "c.exr"}, {"c.exr: ", "precision is double", "b.exr is float"});
}

TEST_F(MergeCliTest, PartsOfDifferentScenesAreRefused) {
  part("a.exr", "0:2");
  folder_.write("other.xml", with_filter("<rfilter type=\"mitchell\"/>"));
  part("same.exr", "2:4", {"other.xml"});
  (void)merge({"a.exr", "same.exr"});
  folder_.write("other.xml", with_filter("<float name=\"fov\" value=\"31\"/>"));
  part("b.exr", "2:4", {"other.xml"});
  expect_refusal({"a.exr", "b.exr"}, {"b.exr: ", "scene is other.xml", "a.exr is scene.xml"});
  folder_.write("scene.xml",
                with_filter("<rfilter type=\"mitchell\"><float name=\"B\" value=\"0.5\"/></rfilter>"));
  part("b.exr", "2:4");
  expect_refusal({"a.exr", "b.exr"}, {"b.exr: ", "filter is mitchell, radius 2, B 0.5", "a.exr"});
  folder_.write("scene.xml", with_filter("<rfilter type=\"mitchell\"/>"));
  folder_.write("light.obj", "v -0.5 1 -0.5\nv 0.5 1 -0.5\nv 0.5 1 0.5\nv -0.5 1 0.51\nf 1 2 3 4\n");
  part("b.exr", "2:4");
  expect_refusal({"a.exr", "b.exr"}, {"b.exr: ", "another version of scene.xml", "a.exr", "changed"});
}

TEST_F(MergeCliTest, OverlapsAreRefused) {
  part("a.exr", "0:4");
  part("b.exr", "4:8");
  part("c.exr", "2:6");
  expect_refusal({"a.exr", "b.exr", "c.exr"}, {"c.exr: ", "overlaps with a.exr", "samples 2:4"});
  expect_refusal({"b.exr", "c.exr", "--allow-gaps"}, {"c.exr: ", "overlaps with b.exr", "samples 4:6"});
  expect_refusal({"a.exr", "b.exr", "./a.exr"}, {"./a.exr: ", "given twice"});
  std::filesystem::copy(folder_.file("a.exr"), folder_.file("copy.exr"));
  expect_refusal({"a.exr", "copy.exr"}, {"copy.exr: ", "overlaps with a.exr", "samples 0:4"});
}

TEST_F(MergeCliTest, GapsAreRefusedUnlessAllowed) {
  part("a.exr", "2:4");
  part("b.exr", "6:8");
  part("c.exr", "9:10");
  expect_refusal({"a.exr", "c.exr", "b.exr"}, {"samples 4:6,8:9 of 2:10", "--allow-gaps"});
  const Image merged = merge({"a.exr", "c.exr", "b.exr", "--allow-gaps"});
  EXPECT_EQ(metadata(merged, "facet.samples"), "2:4,6:8,9:10");
  EXPECT_EQ(metadata(merged, "facet.spp"), "5");
  part("d.exr", "4:6");
  expect_refusal({"a.exr", "b.exr", "d.exr", "--sample-range", "0:10"}, {"samples 0:2,8:10 of 0:10"});
  expect_refusal({"a.exr", "b.exr", "d.exr", "--sample-range", "2:7"}, {"b.exr: ", "outside", "2:7", "6:8"});
  expect_refusal({"a.exr", "--sample-range", "2-7"}, {"--sample-range \"2-7\"", "A:B"});
  (void)merge({"a.exr", "b.exr", "d.exr", "--sample-range", "2:8"});
}

TEST_F(MergeCliTest, FilesThatAreNoParts) {
  part("a.exr", "0:4");
  render("whole.exr", {});
  expect_refusal({"a.exr", "whole.exr"}, {"whole.exr: ", "whole image", "facet render --sample-range"});
  Image stripped = read("a.exr");
  stripped.metadata.clear();
  write_exr(folder_.file("stripped.exr"), stripped);
  expect_refusal({"a.exr", "stripped.exr"},
                 {"stripped.exr: ", "no part", "lacks facet.", "facet render --sample-range"});
  write_exr(folder_.file("foreign.exr"), Image(4, 4, {"R", "G", "B"}));
  expect_refusal({"foreign.exr"}, {"foreign.exr: ", "no part", "facet render --sample-range"});
  const std::string bytes = folder_.read("a.exr");
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, bytes.size() / 2, bytes.size() - 1}) {
    folder_.write("cut.exr", bytes.substr(0, size));
    expect_refusal({"cut.exr"}, {"cut.exr: ", "not a readable EXR"});
  }
  expect_refusal({"a.exr", "none.exr"}, {"none.exr: no such file"});
  expect_refusal({"scene.xml"}, {"scene.xml: not a readable EXR"});
}

TEST_F(MergeCliTest, InterruptedAndChangedPartsAreRefused) {
  part("a.exr", "0:4");
  const auto changed = [&](const std::string& key, const std::string& text) {
    Image image = read("a.exr");
    for (auto& [name, value] : image.metadata) {
      if (name == key) value = text;
    }
    write_exr(folder_.file("b.exr"), image);
  };
  changed("facet.complete", "no: interrupted");
  expect_refusal({"b.exr"}, {"b.exr: ", "interrupted", "0:4"});
  changed("facet.samples", "4:0");
  expect_refusal({"b.exr"}, {"b.exr: ", "facet.samples", "4:0"});
  changed("facet.samples", "0:3");
  expect_refusal({"b.exr"}, {"b.exr: ", "pixel (0, 0)", "has 4 in samples", "3 samples"});
  Image brighter = read("a.exr");
  brighter.at(8, 10, brighter.find_channel("G")) = 7;
  write_exr(folder_.file("b.exr"), brighter);
  expect_refusal({"b.exr"}, {"b.exr: ", "pixel (8, 10)", "G = 7"});
}

TEST_F(MergeCliTest, AnInterruptedRenderIsNoPart) {
  Result result;
  for (int delay = 400; delay < 20000; delay *= 2) {
    const pid_t child = start({"render", "scene.xml", "--sample-range", "5:1000000000", "-o", "a.exr"});
    std::this_thread::sleep_for(std::chrono::milliseconds(delay));
    ASSERT_EQ(::kill(child, SIGINT), 0);
    result = finish(child);
    if (result.code == 130) break;
  }
  ASSERT_EQ(result.code, 130) << result.err;
  expect_refusal({"a.exr"}, {"a.exr: ", "interrupted", "5:1000000000"});
}

TEST_F(MergeCliTest, Outputs) {
  part("a.exr", "0:4");
  part("b.exr", "4:8");
  expect_failure({"merge", "a.exr", "b.exr"}, 2, {"--output", "required"});
  expect_failure({"merge", "-o", "m.exr"}, 2, {"parts", "required"});
  expect_failure({"merge", "a.exr", "b.exr", "-o", "m.jpg"}, 2, {"m.jpg", ".exr or .png"});
  expect_failure({"merge", "a.exr", "b.exr", "-o", "none/m.exr"}, 2, {"none/m.exr", "no such folder"});
  expect_failure({"merge", "a.exr", "b.exr", "-o", "m.exr", "-o", "./m.exr"}, 2, {"./m.exr", "twice"});
  expect_failure({"merge", "a.exr", "b.exr", "-o", "m.exr", "--json", "m.exr"}, 2, {"m.exr", "twice"});
  expect_failure({"merge", "a.exr", "b.exr", "-o", "m.png", "--exposure", "nan"}, 2, {"--exposure"});
  // A sum that grows: the output may be one of the parts, which are read before it is written.
  const Image merged = merge({"a.exr", "b.exr"});
  EXPECT_EQ(run({"merge", "a.exr", "b.exr", "-o", "a.exr", "--quiet"}).code, 0);
  EXPECT_EQ(folder_.read("a.exr"), folder_.read("merged.exr"));
  EXPECT_EQ(merged.width(), 16);
}

TEST_F(MergeCliTest, NeedsNoDriver) {
  part("a.exr", "0:4");
  EXPECT_EQ(run({"merge", "a.exr", "-o", "m.exr"}, {"VK_ICD_FILENAMES=/nonexistent.json"}).code, 0);
}

}  // namespace

}  // namespace facet::test
