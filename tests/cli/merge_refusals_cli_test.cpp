// `facet merge` refuses what does not belong together, and says why.
#include "cli/merge.h"

namespace facet::test {

namespace {

TEST_F(MergeCliTest, PartsOfDifferentRendersAreRefused) {
  part("a.exr", "0:2");
  const std::vector<std::pair<Names, Names>> differences{
      {{"--seed", "1"}, {"seed is 1", "is 0"}},
      {{"--integrator", "path_mats"}, {"integrator is path_mats", "is path_mis"}},
      {{"--max-depth", "3"}, {"maximum depth is 3", "is -1"}},
      {{"--heuristic", "power"}, {"heuristic is power", "is balance"}},
      {{"--emitter-selection", "uniform"}, {"emitter selection is uniform", "is contribution"}},
      {{"--sampler", "sobol"}, {"sampler is sobol", "is independent"}},
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

// What zsobol's numbers are depends on how many samples there are to be.
TEST_F(MergeCliTest, PartsOrderedForDifferentNumbersOfSamplesAreRefused) {
  part("a.exr", "0:2", {"--sampler", "zsobol", "--spp", "8"});
  part("b.exr", "2:4", {"--sampler", "zsobol", "--spp", "4"});
  expect_refusal({"a.exr", "b.exr"}, {"b.exr: ", "planned samples per pixel is 4", "a.exr is 8"});
}

TEST_F(MergeCliTest, PartsOfDifferentScenesAreRefused) {
  part("a.exr", "0:2");
  folder_.write("other.xml", with_filter("<rfilter type=\"mitchell\"/>"));
  part("same.exr", "2:4", {"other.xml"});
  (void)merge({"a.exr", "same.exr"});
  folder_.write("other.xml", with_filter("<float name=\"fov\" value=\"31\"/>"));
  part("b.exr", "2:4", {"other.xml"});
  expect_refusal({"a.exr", "b.exr"}, {"b.exr: ", "scene is other.xml", "a.exr is scene.xml"});
  folder_.write(
      "scene.xml",
      with_filter("<rfilter type=\"mitchell\"><float name=\"B\" value=\"0.5\"/></rfilter>"));
  part("b.exr", "2:4");
  expect_refusal({"a.exr", "b.exr"}, {"b.exr: ", "filter is mitchell, radius 2, B 0.5", "a.exr"});
  folder_.write("scene.xml", with_filter("<rfilter type=\"mitchell\"/>"));
  folder_.write("light.obj",
                "v -0.5 1 -0.5\nv 0.5 1 -0.5\nv 0.5 1 0.5\nv -0.5 1 0.51\nf 1 2 3 4\n");
  part("b.exr", "2:4");
  expect_refusal({"a.exr", "b.exr"},
                 {"b.exr: ", "another version of scene.xml", "a.exr", "changed"});
}

TEST_F(MergeCliTest, OverlapsAreRefused) {
  part("a.exr", "0:4");
  part("b.exr", "4:8");
  part("c.exr", "2:6");
  expect_refusal({"a.exr", "b.exr", "c.exr"}, {"c.exr: ", "overlaps with a.exr", "samples 2:4"});
  expect_refusal({"b.exr", "c.exr", "--allow-gaps"},
                 {"c.exr: ", "overlaps with b.exr", "samples 4:6"});
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
  expect_refusal({"a.exr", "b.exr", "d.exr", "--sample-range", "0:10"},
                 {"samples 0:2,8:10 of 0:10"});
  expect_refusal({"a.exr", "b.exr", "d.exr", "--sample-range", "2:7"},
                 {"b.exr: ", "outside", "2:7", "6:8"});
  expect_refusal({"a.exr", "--sample-range", "2-7"}, {"--sample-range \"2-7\"", "A:B"});
  (void)merge({"a.exr", "b.exr", "d.exr", "--sample-range", "2:8"});
}

TEST_F(MergeCliTest, FilesThatAreNoParts) {
  part("a.exr", "0:4");
  render("whole.exr", {});
  expect_refusal({"a.exr", "whole.exr"}, {"whole.exr: ", "whole image", "facet render --part"});
  Image stripped = read("a.exr");
  stripped.metadata.clear();
  write_exr(folder_.file("stripped.exr"), stripped);
  expect_refusal({"a.exr", "stripped.exr"},
                 {"stripped.exr: ", "no part", "lacks facet.", "facet render --part"});
  write_exr(folder_.file("foreign.exr"), Image(4, 4, {"R", "G", "B"}));
  expect_refusal({"foreign.exr"}, {"foreign.exr: ", "no part", "facet render --part"});
  const std::string bytes = folder_.read("a.exr");
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{100}, bytes.size() / 2, bytes.size() - 1}) {
    folder_.write("cut.exr", bytes.substr(0, size));
    expect_refusal({"cut.exr"}, {"cut.exr: ", size == 0 ? "it is empty" : "not a readable EXR"});
  }
  expect_refusal({"a.exr", "none.exr"}, {"none.exr: no such file"});
  expect_refusal({"scene.xml"}, {"scene.xml: it is not an OpenEXR image"});
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
  changed("facet.stoppedBy", "interrupt");
  expect_refusal({"b.exr"}, {"b.exr: ", "interrupted", "0:4"});
  changed("facet.samples", "4:0");
  expect_refusal({"b.exr"}, {"b.exr: ", "facet.samples", "4:0"});
  for (const char* ranges : {"2:4,0:2", "0:3,2:4", "0:2,1:2", "0:2,2", ":", ""}) {
    changed("facet.samples", ranges);
    expect_refusal({"b.exr"}, {"b.exr: damaged: facet.samples is", ranges, "ascending"});
  }
  changed("facet.samples", "0:3");
  expect_refusal({"b.exr"}, {"b.exr: damaged: facet.spp is \"4\"", "the number of facet.samples"});
  changed("facet.spp", "four");
  expect_refusal({"b.exr"}, {"b.exr: damaged: facet.spp is \"four\""});
  changed("facet.seed", "-1");
  expect_refusal({"b.exr"}, {"b.exr: damaged: facet.seed is \"-1\""});
  changed("facet.seconds", "soon");
  expect_refusal({"b.exr"}, {"b.exr: damaged: facet.seconds is \"soon\""});
  Image fewer = read("a.exr");
  for (auto& [name, value] : fewer.metadata) {
    if (name == "facet.samples") value = "0:3";
    if (name == "facet.spp") value = "3";
  }
  write_exr(folder_.file("b.exr"), fewer);
  expect_refusal({"b.exr"}, {"b.exr: ", "pixel (0, 0)", "has 4 in samples", "3 samples"});
  Image unlike = read("a.exr");
  unlike.at(8, 10, unlike.find_channel("samples")) = 1;
  write_exr(folder_.file("b.exr"), unlike);
  expect_refusal({"b.exr"}, {"b.exr: ", "pixel (8, 10)", "1 samples", "4 of them are not zero"});
  Image brighter = read("a.exr");
  brighter.at(8, 10, brighter.find_channel("G")) = 7;
  write_exr(folder_.file("b.exr"), brighter);
  expect_refusal({"b.exr"}, {"b.exr: ", "pixel (8, 10)", "G = 7"});
}

TEST_F(MergeCliTest, AnInterruptedRenderIsNoPart) {
  Result result;
  for (int delay = 400; delay < 20000; delay *= 2) {
    const pid_t child =
        start({"render", "scene.xml", "--sample-range", "5:1000000000", "-o", "a.exr"});
    std::this_thread::sleep_for(std::chrono::milliseconds(delay));
    ASSERT_EQ(::kill(child, SIGINT), 0);
    result = finish(child);
    if (result.code == 130) break;
  }
  ASSERT_EQ(result.code, 130) << result.err;
  expect_refusal({"a.exr"}, {"a.exr: ", "interrupted", "5:1000000000"});
}

}  // namespace

}  // namespace facet::test
