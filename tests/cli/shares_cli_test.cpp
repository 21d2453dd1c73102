// `facet render --part` and `--tile`: shares of a render, and `facet merge` of them.
#include <nlohmann/json.hpp>

#include "cli/merge.h"

namespace facet::test {

namespace {

/// Shares of a scene of 16x16 pixels.
class SharesCliTest : public MergeCliTest {
 protected:
  /// Renders a share under the name that it gets by itself, in the folder "parts".
  void share(const Names& options) const {
    std::filesystem::create_directory(folder_.file("parts"));
    Names words{"-c", "cd parts && exec \"$0\" \"$@\" ../scene.xml", FACET_PROGRAM, "render",
                "--quiet"};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.begin(), "sh");
    const Result result = finish(start_command(words));
    ASSERT_EQ(result.code, 0) << result.err;
  }
  void remove(const std::string& name) const {
    ASSERT_TRUE(std::filesystem::remove(folder_.file("parts/" + name))) << name;
  }
  void render_all(std::uint32_t parts, std::uint32_t tiles, const Names& options = {}) const {
    for (std::uint32_t t = 1; t <= tiles; ++t) {
      for (std::uint32_t p = 1; p <= parts; ++p) {
        Names words{"--spp",  "10",
                    "--part", fmt::format("{}/{}", p, parts),
                    "--tile", fmt::format("{}/{}", t, tiles)};
        words.insert(words.end(), options.begin(), options.end());
        share(words);
      }
    }
  }
  /// Expects a refusal, which begins with so many commands.
  void expect_missing(const Names& parts, int commands, const std::string& missing) const {
    Names options{"merge", "-o", "none.exr"};
    options.insert(options.end(), parts.begin(), parts.end());
    const Result result = run(options);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), commands + 2) << result.err;
    expect_words(result.err,
                 {"missing; in the folder of scene.xml:\n  facet render ", missing.c_str()});
    EXPECT_FALSE(std::filesystem::exists(folder_.file("none.exr")));
  }
  static void expect_same_colors(const Image& a, const Image& b) {
    ASSERT_EQ(a.width(), b.width());
    ASSERT_EQ(a.height(), b.height());
    for (const char* channel : {"R", "G", "B"}) {
      const float* x = a.plane(a.find_channel(channel));
      const float* y = b.plane(b.find_channel(channel));
      // Sums in another order may round otherwise, by far less than a float shows.
      for (int i = 0; i < a.width() * a.height(); ++i) EXPECT_FLOAT_EQ(x[i], y[i]) << i;
    }
  }
};

TEST_F(SharesCliTest, PartsOfTilesAreTheWhole) {
  render_all(3, 5, {"--sampler", "sobol"});
  EXPECT_TRUE(std::filesystem::exists(folder_.file("parts/scene_tile_5_of_5_part_3_of_3.exr")));
  EXPECT_EQ(metadata(read("parts/scene_tile_2_of_5_part_2_of_3.exr"), "facet.samples"), "3:6");
  EXPECT_EQ(read("parts/scene_tile_2_of_5_part_2_of_3.exr").window.y, 3);
  const Image merged = merge({"parts"});
  EXPECT_EQ(metadata(merged, "facet.samples"), "0:10");
  EXPECT_EQ(metadata(merged, "facet.division"), "no facet.division");
  render("whole.exr", {"--sampler", "sobol", "--spp", "10"});
  expect_same_colors(merged, read("whole.exr"));
}

TEST_F(SharesCliTest, SharesOfACropAndOfItsSquares) {
  const Names options{"--crop", "2,3,14,15", "--aov", "variance"};
  render_all(2, 2, options);
  const Image merged = merge({"parts/*.exr", "--aov", "variance"});
  EXPECT_EQ(merged.window.x, 2);
  EXPECT_EQ(merged.window.y, 3);
  EXPECT_EQ(merged.height(), 12);
  Names whole = options;
  whole.insert(whole.end(), {"--spp", "10"});
  render("whole.exr", whole);
  expect_same_colors(merged, read("whole.exr"));
}

TEST_F(SharesCliTest, TheReferenceDividesAlike) {
  render_all(2, 3, {"--backend", "reference"});
  const Image merged = merge({"parts"});
  render("whole.exr", {"--backend", "reference", "--spp", "10"});
  expect_same_colors(merged, read("whole.exr"));
}

TEST_F(SharesCliTest, MissingSharesAreNamedWithTheCommandsThatRenderThem) {
  const Names options{"--seed", "9", "--aov", "variance"};
  render_all(4, 3, options);
  (void)merge({"parts"});
  const std::string whole = folder_.read("merged.exr");
  remove("scene_tile_1_of_3_part_2_of_4.exr");
  remove("scene_tile_1_of_3_part_4_of_4.exr");
  for (const char* part : {"1", "2", "3", "4"})
    remove(fmt::format("scene_tile_3_of_3_part_{}_of_4.exr", part));
  const Result refused = run({"merge", "parts", "-o", "none.exr"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(refused.err.ends_with(
      "facet: missing: parts 2,4 of 4 of tile 1 of 3; tile 3 of 3: render them\n"))
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.file("none.exr")));
  std::istringstream lines(refused.err);
  int commands = 0;
  constexpr std::string_view start = "  facet ";
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(start)) continue;
    const std::string command =
        fmt::format("'{}' {} --quiet", FACET_PROGRAM, line.substr(start.size()));
    std::string moved = command;
    moved.replace(moved.find(" -- scene.xml --quiet"), std::string::npos, " --quiet -- scene.xml");
    const Result rendered = finish(start_command({"sh", "-c", moved}));
    EXPECT_EQ(rendered.code, 0) << moved << '\n' << rendered.err;
    ++commands;
  }
  EXPECT_EQ(commands, 6);
  (void)merge({"parts"});
  // But for the seconds, which the checksum is of, too.
  expect_same_colors(read("merged.exr"), [&] {
    folder_.write("first.exr", whole);
    return read("first.exr");
  }());
}

TEST_F(SharesCliTest, APartIsMissingAtTheEnd) {
  for (const char* part : {"1/3", "2/3"}) share({"--spp", "6", "--part", part});
  expect_missing({"parts"}, 1, "missing: part 3 of 3:");
  const Image merged = merge({"parts", "--allow-gaps"});
  EXPECT_EQ(metadata(merged, "facet.samples"), "0:4");
  EXPECT_EQ(metadata(merged, "facet.division"), "3 parts of 0:6, 1 tiles of 0,0,16,16");
  const Result info = run({"info", "parts/scene_part_2_of_3.exr"});
  expect_words(info.out, {"a part, part 2 of 3:"});
}

TEST_F(SharesCliTest, MergesOfATreeAreTheMergeOfAll) {
  render_all(3, 2);
  const Image all = merge({"parts"});
  for (const char* tile : {"1", "2"}) {
    const std::string name = fmt::format("tile{}.exr", tile);
    const Result result = run({"merge", fmt::format("parts/scene_tile_{}_*.exr", tile), "-o", name,
                               "--allow-gaps", "--quiet"});
    ASSERT_EQ(result.code, 0) << result.err;
  }
  expect_missing({"tile1.exr"}, 3, "missing: tile 2 of 2:");
  expect_same_colors(merge({"tile1.exr", "tile2.exr"}), all);
}

TEST_F(SharesCliTest, MergesOfSeveralTilesAreMergedAgain) {
  render_all(1, 4);
  const Image all = merge({"parts"});
  const std::string start = "parts/scene_tile_";
  for (const char* tiles : {"12", "34"}) {
    Names words{"merge", "-o", fmt::format("{}.exr", tiles), "--allow-gaps", "--quiet"};
    for (const char* tile = tiles; *tile != '\0'; ++tile)
      words.push_back(fmt::format("{}{}_of_4_part_1_of_1.exr", start, *tile));
    const Result result = run(words);
    ASSERT_EQ(result.code, 0) << result.err;
  }
  expect_missing({"12.exr"}, 2, "missing: tiles 3,4 of 4:");
  const Image merged = merge({"12.exr", "34.exr"});
  expect_same_colors(merged, all);
  EXPECT_EQ(metadata(merged, "facet.division"), "no facet.division");
}

TEST_F(SharesCliTest, MergesAcrossTilesAreMergedAgain) {
  render_all(2, 2);
  const Image all = merge({"parts"});
  for (const char* part : {"1", "2"}) {
    const Result result = run({"merge", fmt::format("parts/*part_{}_of_2.exr", part), "-o",
                               fmt::format("{}.exr", part), "--allow-gaps", "--quiet"});
    ASSERT_EQ(result.code, 0) << result.err;
  }
  expect_same_colors(merge({"1.exr", "2.exr"}), all);
  expect_same_colors(merge({"2.exr", "parts/scene_tile_1_of_2_part_1_of_2.exr",
                            "parts/scene_tile_2_of_2_part_1_of_2.exr"}),
                     all);
  expect_refusal({"1.exr", "2.exr", "parts/scene_tile_2_of_2_part_1_of_2.exr"},
                 {"scene_tile_2_of_2_part_1_of_2.exr: overlaps with 1.exr", "samples 0:5"});
  expect_missing({"1.exr", "parts/scene_tile_2_of_2_part_2_of_2.exr"}, 1,
                 "missing: part 2 of 2 of tile 1 of 2: render them\n");
  expect_refusal({"1.exr", "parts/scene_tile_2_of_2_part_2_of_2.exr", "--allow-gaps"},
                 {"all pixels of an image have the same"});
}

TEST_F(SharesCliTest, SharesOfAnotherDivisionAreRefused) {
  for (const char* part : {"1/4", "2/4"}) share({"--spp", "12", "--part", part});
  share({"--spp", "8", "--part", "4/4", "-o", "other.exr"});
  expect_refusal({"parts"}, {"of 4 parts of 0:12, 1 tiles", "of 4 parts of 0:8, 1 tiles"});
  // What is no share of any may stand for one.
  ASSERT_TRUE(std::filesystem::remove(folder_.file("parts/other.exr")));
  share({"--spp", "12", "--sample-range", "6:12", "-o", "rest.exr"});
  (void)merge({"parts"});
}

TEST_F(SharesCliTest, TilesThatDoNotFitAreRefused) {
  share({"--tile", "1/2"});
  share({"--tile", "2/3"});
  expect_refusal({"parts"}, {"scene_tile_2_of_3.exr: is of 1 parts of 0:1, 3 tiles",
                             "scene_tile_1_of_2.exr is of 1 parts of 0:1, 2 tiles"});
  share({"--tile", "1/3"});
  share({"--tile", "3/3"});
  remove("scene_tile_1_of_2.exr");
  (void)merge({"parts"});
  remove("scene_tile_2_of_3.exr");
  expect_missing({"parts"}, 1, "missing: tile 2 of 3:");
  expect_refusal({"parts", "--allow-gaps"}, {"no part holds 80 of the pixels 0,0,16,16"});
  share({"--tile", "2/3", "--spp", "5"});
  expect_refusal({"parts", "--allow-gaps"}, {"of 1 parts of 0:5", "of 1 parts of 0:1"});
}

TEST_F(SharesCliTest, ADamagedDivisionIsRefused) {
  share({"--part", "1/2", "--spp", "4"});
  const auto changed = [&](const std::string& text) {
    Image image = read("parts/scene_part_1_of_2.exr");
    for (auto& [key, value] : image.metadata) {
      if (key == "facet.division") value = text;
    }
    write_exr(folder_.file("b.exr"), image);
  };
  changed("many");
  expect_refusal({"b.exr"}, {"b.exr: damaged: facet.division is \"many\""});
  changed("2 parts of 2:4, 1 tiles of 0,0,16,16");
  expect_refusal({"b.exr"}, {"b.exr: damaged: its samples 0:2", "no share of 2 parts of 2:4"});
  changed("3 parts of 0:4, 1 tiles of 0,0,16,16");
  expect_refusal({"b.exr", "--allow-gaps"}, {"b.exr: damaged", "checksum"});
}

TEST_F(SharesCliTest, FoldersAndPatternsWithoutParts) {
  std::filesystem::create_directory(folder_.file("parts"));
  expect_refusal({"parts"}, {"parts: no .exr lies in this folder"});
  expect_refusal({"parts/*.exr"}, {"parts/*.exr: no file has a name like this"});
  share({"--part", "1/2", "--spp", "4"});
  share({"--part", "2/2", "--spp", "4"});
  folder_.write("parts/.hidden.exr", "");
  folder_.write("parts/notes.txt", "");
  (void)merge({"parts"});
  // What was merged into the same folder is no part of the next merge.
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(run({"merge", "parts", "-o", "parts/all.exr", "--quiet"}).code, 0);
  expect_refusal({"parts"}, {"overlap"});
}

TEST_F(SharesCliTest, SharesThatCannotBe) {
  const auto refused = [&](Names options, std::initializer_list<const char*> words) {
    options.insert(options.begin(), {"render", "scene.xml", "-o", "none.exr"});
    expect_failure(options, 2, words);
  };
  for (const char* text : {"", "0/4", "5/4", "x", "4", "2/x", "-1/3"}) {
    refused({"--part", text}, {"--part", "I/N"});
    refused({"--tile", text}, {"--tile", "I/N"});
  }
  refused({"--part", "1/5"}, {"part 1 of 5: more shares than samples a pixel, 1"});
  refused({"--tile", "1/17"}, {"tile 1 of 17: more shares than rows of pixels, 16"});
  refused({"--part", "1/2", "--spp", "4", "--sample-range", "0:2"},
          {"part", "sample range", "exclude"});
  refused({"--tile", "1/2", "--pixel", "1,1"}, {"tile", "pixel", "exclude"});
  refused({"--part", "1/2", "--adaptive", "--spp", "64"}, {"adaptive"});
  refused({"--tile", "1/2", "--error", "1%"}, {"tile", "error"});
  refused({"--part", "1/2", "--spp", "4", "--time", "2"}, {"part", "time"});
}

TEST_F(SharesCliTest, ACheckpointOfAShareContinuesAsThatShare) {
  const pid_t child = start({"render", "scene.xml", "--spp", "4000000", "--part", "2/4", "--tile",
                             "1/2", "--checkpoint", "c.exr", "-o", "a.exr", "--seed", "3"});
  for (int i = 0; i < 600 && !std::filesystem::exists(folder_.file("c.exr")); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    if (i % 10 == 9) ::kill(child, SIGINT);
  }
  (void)finish(child);
  ASSERT_TRUE(std::filesystem::exists(folder_.file("c.exr")));
  const Result info = run({"info", "c.exr"});
  expect_words(info.out, {"facet render --part=2/4 --tile=1/2 --spp=4000000 --resolution=16x16",
                          "--seed=3", "--checkpoint=c.exr --resume -- scene.xml"});
}

}  // namespace

}  // namespace facet::test
