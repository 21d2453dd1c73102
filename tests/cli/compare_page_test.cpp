// The page of `facet compare --html`, as a browser shows it: controls are driven by a script added
// to a copy of the page.
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/page_checks.h"
#include "cli/program.h"
#include "image/files.h"

namespace facet::test {

namespace {

class ComparePageTest : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    browser_ = find_browser();
    if (browser_.empty()) GTEST_SKIP() << "no chromium to look at the page with";
    Image a(40, 30, {"R", "G", "B"});
    for (int c = 0; c < 3; ++c) std::fill_n(a.plane(c), 1200, 0.25F);
    a.window = {10, 20, 100, 100};
    a.metadata = {{"facet.scene", "a b's</script><script>document.title='x'</script>.xml"},
                  {"facet.integrator", "path"},
                  {"facet.samples", "3:9"},
                  {"facet.seed", "7"},
                  {"facet.maxDepth", "-1"},
                  {"facet.backend", "vulkan"}};
    Image b = a;
    b.metadata[3].second = "8";
    for (int c = 0; c < 3; ++c) b.at(0, 0, c) = 0.5F;
    b.at(2, 1, 0) = 0.251F;
    a.at(0, 0, 0) = 1;
    a.at(0, 0, 1) = 40000;
    a.at(0, 0, 2) = 0;
    a.at(3, 2, 1) = NAN;
    write_exr(folder_.file(name_a_), a);
    write_exr(folder_.file("b.exr"), b);
    const Result result =
        run({"compare", name_a_, "b.exr", "--html", "page.html", "--max-rmse", "0.1"});
    EXPECT_EQ(result.code, 1) << result.err;
  }

  /// What the script found in the page.
  [[nodiscard]] nlohmann::json look(const std::string& options = "") const {
    return look_at(browser_, folder_.file("page.html"), FACET_PAGE_CHECKS, options);
  }

  const std::string name_a_ = "a<b>&\"'{{data}}.exr";
  std::string browser_;
};

using Codes = std::vector<int>;
using Names = std::vector<std::string>;

TEST_F(ComparePageTest, NamesAreText) {
  const nlohmann::json page = look();
  EXPECT_EQ(page["title"], name_a_ + " against b.exr");
  EXPECT_EQ(page["heading"], "A " + name_a_ + " against the reference B b.exr");
  EXPECT_NE(page["origins"].get<std::string>().find(
                "a b's</script><script>document.title='x'</script>.xml"),
            std::string::npos);
  EXPECT_EQ(page["problems"], Names{});
}

TEST_F(ComparePageTest, NeedsNothingElse) { EXPECT_EQ(look()["requests"], Names{}); }

TEST_F(ComparePageTest, ImagesAreDrawn) {
  const nlohmann::json page = look();
  EXPECT_EQ(page["sizes"], (std::vector<Codes>{{40, 30}, {40, 30}, {40, 30}}));
  const Codes missing{0, 184, 196};
  EXPECT_EQ(page["a"], (std::vector<Codes>{{255, 255, 0}, {137, 137, 137}, missing}));
  EXPECT_EQ(page["b"], (std::vector<Codes>{{188, 188, 188}, {137, 137, 137}}));
  EXPECT_EQ(page["exposure"], "+1 EV");
  EXPECT_EQ(page["brighter"], (Codes{188, 188, 188})) << "0.25, one stop brighter";
}

TEST_F(ComparePageTest, ControlsWork) {
  const nlohmann::json page = look();
  EXPECT_EQ(page["swipe"], "canvas-a divider swipe");
  EXPECT_EQ(page["clip"], "inset(0px 50% 0px 0px)");
  EXPECT_EQ(page["clip25"], "inset(0px 75% 0px 0px)");
  EXPECT_EQ(page["divider"], "25%");
  EXPECT_EQ(page["flipped"], "canvas-a swipe");
  EXPECT_EQ(page["flippedTwice"], "swipe");
  EXPECT_EQ(page["key2"], "canvas-a swipe");
  EXPECT_EQ(page["clipA"], "none");
  EXPECT_EQ(page["map"], "canvas-map legend");
  EXPECT_EQ(page["stage"], (Codes{160, 120}));
  EXPECT_EQ(page["dragged"], "inset(0px 92.5% 0px 0px)");
}

TEST_F(ComparePageTest, MapsAreOrderedByTheError) {
  const nlohmann::json page = look();
  ASSERT_EQ(page["maps"].size(), 3U);
  for (const nlohmann::json& map : page["maps"]) {
    EXPECT_GT(map["worse"].get<double>(), map["equal"].get<double>() + 0.2) << map["note"];
    EXPECT_EQ(map["missing"], (Codes{0, 184, 196}));
  }
  EXPECT_EQ(page["maps"][0]["ticks"], (Names{"0", "0.2", "0.4", "0.6", "0.8", "1"}));
  // sqrt((39999.5^2 + 0.5^2 + 0.5^2) / 3 / 0.25) = 46188 at one pixel, 46558 by the nearest code,
  // and 0.001 / 0.251 / sqrt(3) = 0.0023 at another.
  EXPECT_EQ(page["maps"][2]["ticks"], (Names{"0.1", "1", "10", "100", "1000", "10000", "100000"}));
  const auto scale = page["scale"].get<std::vector<double>>();
  for (std::size_t i = 1; i < scale.size(); ++i) EXPECT_GE(scale[i], scale[i - 1]) << i;
  EXPECT_GT(scale.back(), 0.85);
  EXPECT_LT(scale.front(), 0.01);
}

TEST_F(ComparePageTest, WorstPixelsCanBeSeenAndRenderedAgain) {
  const nlohmann::json page = look();
  EXPECT_EQ(page["buttons"], (Names{"13, 22", "10, 20", "12, 21"}));
  EXPECT_EQ(page["marked"], true);
  const auto readout = page["readout"].get<std::string>();
  expect_words(readout, {"pixel 10, 20: FLIP ≈ ", "HDR-FLIP ≈ ", "Relative error ≈ 4.7e+4",
                         "B 0.5 0.5 0.5"});
  expect_words(page["pointed"].get<std::string>(), {"pixel 11, 20: FLIP ≈ 0.", "B 0.25 0.25 0.25"});
  ASSERT_EQ(page["commands"].size(), 6U);
  EXPECT_EQ(page["commands"][0],
            "facet render --pixel=13,22 --resolution=100x100 --backend=vulkan --integrator=path "
            "--max-depth=-1 --sample-range=3:9 --seed=7 -- "
            "'a b'\\''s</script><script>document.title='\\''x'\\''</script>.xml'");
  EXPECT_NE(page["commands"][3].get<std::string>().find("--pixel=10,20 "), std::string::npos);
  EXPECT_NE(page["commands"][3].get<std::string>().find("--seed=8"), std::string::npos);
}

TEST_F(ComparePageTest, CanBeReadByAllInLightAndDark) {
  for (const bool dark : {false, true}) {
    const nlohmann::json page = look(dark ? "--blink-settings=preferredColorScheme=0"
                                          : "--blink-settings=preferredColorScheme=1");
    SCOPED_TRACE(dark ? "dark" : "light");
    EXPECT_EQ(page["nameless"], Names{});
    EXPECT_GE(page["contrast"].get<double>(), 4.5) << "WCAG 2.1, level AA";
    EXPECT_EQ(page["background"].get<double>() < 0.2, dark);
    EXPECT_EQ(page["bars"].size(), 2U);
    EXPECT_LE(page["overflow"].get<double>(), 0) << "nothing sticks out sideways";
  }
}

}  // namespace

}  // namespace facet::test
