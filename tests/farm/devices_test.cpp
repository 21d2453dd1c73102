// `facet render --device all`: two versions of a driver at once, and the reference as a third.
#include "cli/merge.h"

namespace facet::test {

namespace {

class DevicesTest : public MergeCliTest {
 protected:
  void SetUp() override {
    MergeCliTest::SetUp();
    const Result check = finish(start_command({"sh", FACET_SECOND_DRIVER_SCRIPT, "--check"}));
    if (check.code == 77) GTEST_SKIP() << check.err;
    ASSERT_EQ(check.code, 0) << check.err;
    const std::string folder = trimmed_line(check.out.substr(check.out.rfind(" in ") + 4));
    // The system's own, whose name has the architecture's in it.
    std::string own;
    const std::filesystem::path place = "/usr/share/vulkan/icd.d";
    for (const auto& entry : std::filesystem::directory_iterator(place)) {
      if (entry.path().filename().string().starts_with("lvp_icd")) own = entry.path().string();
    }
    ASSERT_NE(own, "");
    variables_ = {"VK_DRIVER_FILES=" + own + ":" + folder + "/icd.json",
                  "VK_ICD_FILENAMES=" + own + ":" + folder + "/icd.json",
                  "LD_LIBRARY_PATH=" + folder};
  }

  static std::string trimmed_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
  }

  [[nodiscard]] Result render_on(const std::string& devices, const std::string& output) const {
    // Large enough for all to get shares, unless the machine is busy.
    return run({"render", "scene.xml", "--spp", "70", "--resolution", "160x160", "--quiet", "-o",
                output, "--device", devices},
               variables_);
  }

  std::vector<std::string> variables_;
};

void expect_equal(const Image& a, const Image& b) {
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < a.width() * a.height(); ++i) ASSERT_EQ(a.plane(c)[i], b.plane(c)[i]) << i;
  }
}

TEST_F(DevicesTest, TwoDriversGiveTheBitsOfEither) {
  const Result all = render_on("all", "all.exr");
  ASSERT_EQ(all.code, 0) << all.err;
  EXPECT_EQ(all.err, "");
  ASSERT_EQ(render_on("0", "one.exr").code, 0);
  ASSERT_EQ(render_on("1,0", "two.exr").code, 0);
  EXPECT_EQ(metadata(read("all.exr"), "facet.samples"), "0:70");
  expect_equal(read("one.exr"), read("all.exr"));
  expect_equal(read("two.exr"), read("all.exr"));
}

TEST_F(DevicesTest, PartsOfUnlikeMachinesMergeToTheBitsOfOne) {
  const auto part = [&](const std::string& name, int i, const std::string& device,
                        std::vector<std::string> variables) {
    variables.insert(variables.end(), variables_.begin(), variables_.end());
    const Result result = run({"render", "scene.xml", "--spp", "70", "--quiet", "-o", name,
                               "--part", std::to_string(i) + "/4", "--device", device},
                              variables);
    ASSERT_EQ(result.code, 0) << result.err;
  };
  for (int i = 1; i <= 4; ++i) part(std::to_string(i) + ".exr", i, "0", {});
  const Image one = merge({"1.exr", "2.exr", "3.exr", "4.exr"});
  part("2.exr", 2, "1", {});
  part("3.exr", 3, "0", {"LP_NUM_THREADS=1"});
  part("4.exr", 4, "1", {"LP_NUM_THREADS=3"});
  const Image unlike = merge({"1.exr", "2.exr", "3.exr", "4.exr"});
  EXPECT_NE(metadata(unlike, "facet.driver"), metadata(one, "facet.driver"));
  ASSERT_EQ(one.channels(), unlike.channels());
  for (std::size_t c = 0; c < one.channels().size(); ++c) {
    for (int i = 0; i < one.width() * one.height(); ++i)
      ASSERT_EQ(one.plane(static_cast<int>(c))[i], unlike.plane(static_cast<int>(c))[i]);
  }
}

TEST_F(DevicesTest, TheReferenceIsAThirdAndToldOf) {
  const Result result = render_on("0,1,reference", "a.exr");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(metadata(read("a.exr"), "facet.samples"), "0:70");
  // Who is slow may get no share.
  if (metadata(read("a.exr"), "facet.backend") == "vulkan; reference")
    expect_words(result.err, {"warning: ", "CPU reference in float", "with other bits"});
}

TEST_F(DevicesTest, WhatOneDeviceAloneCanDoIsRefused) {
  for (const Names& options : std::initializer_list<Names>{
           {"--error", "1%"}, {"--time", "3"}, {"--adaptive"}, {"--checkpoint", "c.exr"}}) {
    Names words{"render", "scene.xml", "--spp", "64", "-o", "none.exr", "--device", "all"};
    words.insert(words.end(), options.begin(), options.end());
    const Result result = run(words, variables_);
    EXPECT_EQ(result.code, 2);
    expect_words(result.err, {"several devices share"});
  }
}

}  // namespace

}  // namespace facet::test
