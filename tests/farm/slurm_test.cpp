// Array jobs of Slurm, for real: parts of two scenes, one preempted and one killed amid its render,
// started again and merged, are the renders of one process.
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "image/files.h"
#include "support/images.h"

namespace facet::test {

namespace {

class SlurmTest : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    const Result check = script({"--check"});
    if (check.code == 77) GTEST_SKIP() << check.err;
    ASSERT_EQ(check.code, 0) << check.err;
  }

  [[nodiscard]] Result script(std::vector<std::string> words,
                              const std::vector<std::string>& variables = {}) const {
    words.insert(words.begin(), {"sh", FACET_FARM "/slurm/private-cluster.sh"});
    return finish(start_command(words, variables));
  }

  /// Expects the merged image to be the one that a single process renders: the same bits in all but
  /// a thousandth of the pixels, which a float's last step may separate.
  void expect_whole(const std::string& scene, const std::string& merged,
                    const std::vector<std::string>& options) const {
    std::vector<std::string> words{"render", scene, "-o", "whole.exr", "--quiet"};
    words.insert(words.end(), options.begin(), options.end());
    const Result result = run(words);
    ASSERT_EQ(result.code, 0) << result.err;
    const Image a = read_exr(folder_.file("whole.exr"));
    const Image b = read_exr(folder_.file(merged));
    ASSERT_EQ(a.width(), b.width());
    ASSERT_EQ(a.height(), b.height());
    const int pixels = a.width() * a.height();
    std::vector<bool> differs(static_cast<std::size_t>(pixels));
    for (const char* channel : {"R", "G", "B"}) {
      const float* x = a.plane(a.find_channel(channel));
      const float* y = b.plane(b.find_channel(channel));
      for (int i = 0; i < pixels; ++i) {
        ASSERT_LE(ulps_between(x[i], y[i]), 1) << i;
        if (x[i] != y[i]) differs[static_cast<std::size_t>(i)] = true;
      }
    }
    const auto different = std::count(differs.begin(), differs.end(), true);
    fmt::print("{}: {} of {} pixels differ in a bit\n", scene, different, pixels);
    EXPECT_LE(different, pixels / 1000);
    EXPECT_GT(largest(a), 0);
  }
};

TEST_F(SlurmTest, PartsThatWereKilledAndRequeuedAreTheWhole) {
  const std::string a = FACET_SCENES "/cbox/cbox_conductors_mis.xml";
  const std::string b = FACET_SCENES "/veach_mi/veach_mi_mis.xml";
  const std::vector<std::string> options{"--resolution", "96x96", "--spp", "1600"};
  std::vector<std::string> words{
      "sh", FACET_KILL_AND_REQUEUE, FACET_FARM "/slurm/submit.sh", a, "a", b, "b"};
  words.insert(words.end(), options.begin(), options.end());
  const Result result =
      script(words, {std::string("FACET=") + FACET_PROGRAM, "FACET_CHECKPOINT_EVERY=0.05"});
  ASSERT_EQ(result.code, 0) << result.out << result.err;
  fmt::print("{}", result.out);
  expect_words(result.out, {"preempted: part", "killed: part"});
  // The one that was preempted, and the one that was killed.
  std::size_t restarts = 0;
  for (std::size_t at = 0; (at = result.out.find("Restarts=1", at)) != std::string::npos; ++at)
    ++restarts;
  EXPECT_EQ(restarts, 2U) << result.out;
  expect_whole(a, "a/cbox_conductors_mis.exr", options);
  expect_whole(b, "b/veach_mi_mis.exr", options);
}

TEST_F(SlurmTest, AFarmPlansScriptRendersTheWhole) {
  const std::vector<std::string> options{"--spp", "3000"};
  const Result plan = run({"farm-plan", "scene.xml", "--spp", "3000", "--nodes", "4", "--measure",
                           "0.2", "--script", "plan.sh"});
  ASSERT_EQ(plan.code, 0) << plan.err;
  const Result result = script(
      {"sh", "-c", "sh plan.sh && while [ -n \"$(squeue --noheader)\" ]; do sleep 0.2; done"},
      {std::string("FACET=") + FACET_PROGRAM});
  ASSERT_EQ(result.code, 0) << result.out << result.err;
  std::filesystem::rename(folder_.file("scene.exr"), folder_.file("merged.exr"));
  EXPECT_TRUE(std::filesystem::exists(folder_.file("scene.png")));
  expect_whole("scene.xml", "merged.exr", options);
}

}  // namespace

}  // namespace facet::test
