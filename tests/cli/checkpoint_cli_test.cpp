// Renders that are killed and resumed end with the bits of those that were not, and checkpoints of
// anything else are refused.
#include <regex>

#include "cli/program.h"
#include "image/files.h"
#include "image/record.h"

namespace facet::test {
namespace {

using Words = std::vector<std::string>;

class CheckpointCliTest : public CliTest {
 protected:
  [[nodiscard]] std::filesystem::path checkpoint() const { return folder_.file("ck.exr"); }

  static Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// A render that is saved as often as it can be.
  static Words saved(const Words& options) {
    return with({"render", "scene.xml", "--checkpoint", "ck.exr", "--checkpoint-every", "0.01"},
                options);
  }

  /// Returns whether there was a new checkpoint before the program ended.
  [[nodiscard]] bool wait_for_checkpoint(pid_t child) const {
    std::error_code none;
    const auto before = std::filesystem::last_write_time(checkpoint(), none);
    for (;;) {
      siginfo_t info{};
      if (::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
          info.si_pid == child)
        return false;
      std::error_code missing;
      const auto now = std::filesystem::last_write_time(checkpoint(), missing);
      if (!missing && now != before) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  /// Ends a long render by SIGTERM once there is a checkpoint.
  void make_checkpoint(const Words& options) const {
    const pid_t child = start(saved(with({"--spp", "100000000", "-o", "a.exr"}, options)));
    ASSERT_TRUE(wait_for_checkpoint(child));
    ASSERT_EQ(::kill(child, SIGTERM), 0);
    const Result result = finish(child);
    ASSERT_EQ(result.code, 130) << result.err;
  }

  /// Channels and their bits.
  static void expect_same_bits(const Image& a, const Image& b) {
    ASSERT_EQ(a.channels(), b.channels());
    ASSERT_EQ(a.width() * a.height(), b.width() * b.height());
    const auto pixels = static_cast<std::size_t>(a.width()) * static_cast<std::size_t>(a.height());
    const std::size_t bytes = pixels * a.channels().size() * sizeof(float);
    EXPECT_EQ(std::memcmp(a.plane(0), b.plane(0), bytes), 0);
    for (const RecordField& field : record_fields()) {
      if (std::string_view(field.key) == "facet.seconds") continue;
      const std::string* its = find_metadata(a.metadata, field.key);
      const std::string* other = find_metadata(b.metadata, field.key);
      ASSERT_EQ(its == nullptr, other == nullptr) << field.key;
      if (its != nullptr) {
        EXPECT_EQ(*its, *other) << field.key;
      }
    }
  }

  /// Renders through, and killed time and again.
  void expect_survives_kills(const Words& options) const {
    SCOPED_TRACE(::testing::PrintToString(options));
    const Result whole = run(with({"render", "scene.xml", "-o", "whole.exr"}, options));
    ASSERT_EQ(whole.code, 0) << whole.err;
    const Words words = saved(with({"--resume", "-o", "resumed.exr"}, options));
    int kills = 0;
    for (; kills < 4; ++kills) {
      const pid_t child = start(words);
      const bool killed = wait_for_checkpoint(child) && ::kill(child, SIGKILL) == 0;
      if (finish(child).code == 0) break;
      ASSERT_TRUE(killed);
    }
    EXPECT_GT(kills, 0) << "the render ended too soon";
    if (std::filesystem::exists(checkpoint())) {
      const Result last = run(words);
      EXPECT_EQ(last.code, 0);
      expect_words(last.err, {"ck.exr: continued\n"});
    }
    expect_same_bits(read_exr(folder_.file("resumed.exr")), read_exr(folder_.file("whole.exr")));
    EXPECT_FALSE(std::filesystem::exists(checkpoint())) << "there is nothing left to continue";
    for (const std::string& name : folder_.names())
      EXPECT_FALSE(name.starts_with(".facet")) << name;
  }
};

TEST_F(CheckpointCliTest, KilledRendersEndWithTheSameBits) {
  expect_survives_kills({"--spp", "6000", "--sampler", "sobol"});
  expect_survives_kills({"--sample-range", "7:6000", "--aov", "variance"});
}

TEST_F(CheckpointCliTest, KilledRendersWithStopRulesEndWithTheSameBits) {
  expect_survives_kills({"--error", "3%", "--aov", "variance,error", "--sampler", "sobol"});
}

TEST_F(CheckpointCliTest, KilledAdaptiveRendersEndWithTheSameBits) {
  expect_survives_kills({"--spp", "6000", "--adaptive"});
  expect_survives_kills({"--error", "3%", "--adaptive", "--sampler", "sobol"});
}

TEST_F(CheckpointCliTest, KilledRendersOfTheReferenceEndWithTheSameBits) {
  expect_survives_kills({"--spp", "2000", "--backend", "reference", "--precision", "float"});
  expect_survives_kills({"--spp", "2000", "--backend", "reference", "--adaptive"});
}

// Batch systems send a signal to a process and to its group.
TEST_F(CheckpointCliTest, TwoSignalsAtATimeAreOne) {
  const pid_t child = start(saved({"--spp", "100000000", "-o", "a.exr"}));
  ASSERT_TRUE(wait_for_checkpoint(child));
  ::kill(child, SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(child, SIGTERM);
  EXPECT_EQ(finish(child).code, 130);
  EXPECT_TRUE(std::filesystem::exists(folder_.file("a.exr")));
  EXPECT_TRUE(std::filesystem::exists(checkpoint()));
}

TEST_F(CheckpointCliTest, AnInterruptSavesWhatThereIs) {
  make_checkpoint({});
  const ExrHeader header = read_exr_header(checkpoint());
  // What is there is whole: parts need no --sample-range to be merged.
  const Result merged = run({"merge", "ck.exr", "-o", "merged.exr", "--quiet"});
  ASSERT_EQ(merged.code, 0) << merged.err;
  const Image image = read_exr(folder_.file("merged.exr"));
  EXPECT_EQ(image.width(), 16);
  EXPECT_EQ(*find_metadata(image.metadata, "facet.samples"),
            *find_metadata(header.metadata, "facet.samples"));
}

TEST_F(CheckpointCliTest, ARenderGoesOnAsItBeganWhoeverLooksOn) {
  // Whether its error is estimated, which costs samples of its own.
  const Words sobol{"--sampler", "sobol"};
  const Words reported = with(sobol, {"--json", "r.json"});
  for (const bool estimated : {false, true}) {
    std::filesystem::remove(checkpoint());
    make_checkpoint(estimated ? reported : sobol);
    const pid_t child = start(saved(
        with({"--spp", "100000000", "-o", "a.exr", "--resume"}, estimated ? sobol : reported)));
    EXPECT_TRUE(wait_for_checkpoint(child));
    ::kill(child, SIGTERM);
    const Result result = finish(child);
    EXPECT_EQ(result.code, 130) << result.err;
    expect_words(result.err, {"continued"});
  }
}

TEST_F(CheckpointCliTest, CheckpointsOfOtherRendersAreRefused) {
  make_checkpoint({"--seed", "3"});
  const std::string before = folder_.read("ck.exr");
  const auto expect_refused = [&](const Words& options, std::initializer_list<const char*> words) {
    expect_failure(saved(with({"--resume", "--quiet", "-o", "b.exr"}, options)), 2, words);
  };
  const Words same{"--seed", "3", "--spp", "100000000"};
  expect_refused({"--seed", "4", "--spp", "100000000"}, {"ck.exr: its seed is 3", "is 4"});
  expect_refused({"--seed", "3", "--spp", "64"}, {"range of samples is 0:100000000", "0:64"});
  expect_refused(with(same, {"--integrator", "path_mis"}), {"integrator is direct_mis", "path"});
  expect_refused(with(same, {"--resolution", "16x15"}), {"image is 16x16", "16x15"});
  expect_refused(with(same, {"--crop", "0,0,8,8"}), {"crop is 0,0,16,16", "0,0,8,8"});
  expect_refused(with(same, {"--sampler", "sobol"}), {"sampler is independent", "sobol"});
  expect_refused(with(same, {"--error", "1%"}), {"error to stop at is none", "0.01"});
  expect_refused(with(same, {"--time", "60"}), {"time to stop at is none", "there"});
  expect_refused(with(same, {"--adaptive"}), {"adaptive"});
  expect_refused(with(same, {"--backend", "reference"}), {"backend is vulkan", "reference"});
  write_scene("scene.xml", light() + floor());
  expect_refused(same, {"another version of", "scene.xml"});
  EXPECT_EQ(folder_.read("ck.exr"), before) << "nothing is written over";
}

TEST_F(CheckpointCliTest, NoCheckpointIsWrittenOver) {
  folder_.write("ck.exr", "hours of work");
  expect_failure(saved({"-o", "a.exr"}), 2, {"ck.exr: is there already", "--resume"});
  expect_failure(saved({"-o", "a.exr", "--resume"}), 2, {"ck.exr: it is not an OpenEXR image"});
  EXPECT_EQ(folder_.read("ck.exr"), "hours of work");
}

TEST_F(CheckpointCliTest, OptionsThatMakeNoSenseAreRefused) {
  expect_failure({"render", "scene.xml", "--resume"}, 2, {"--resume", "--checkpoint"});
  expect_failure({"render", "scene.xml", "--checkpoint", "ck.png"}, 2, {"ck.png", ".exr"});
  expect_failure({"render", "scene.xml", "-o", "a.exr", "--checkpoint", "a.exr"}, 2,
                 {"a.exr", "written twice"});
  expect_failure({"render", "scene.xml", "--checkpoint", "no/ck.exr"}, 2, {"no such folder"});
}

TEST_F(CheckpointCliTest, StartsAnewWithoutAFile) {
  const Result result = run(saved({"--resume", "-o", "a.exr"}));
  EXPECT_EQ(result.code, 0);
  expect_words(result.err, {"ck.exr: no such file yet, so it starts anew"});
  EXPECT_FALSE(std::filesystem::exists(checkpoint()));
}

TEST_F(CheckpointCliTest, ALastCheckpointThatCannotBeWrittenIsAnErrorAndLosesNoImage) {
  std::filesystem::create_directory(folder_.file("gone"));
  const pid_t child = start({"render", "scene.xml", "-o", "a.exr", "--spp", "100000000",
                             "--checkpoint", "gone/ck.exr", "--checkpoint-every", "0.01"});
  while (!std::filesystem::exists(folder_.file("gone/ck.exr")))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::filesystem::remove_all(folder_.file("gone"));
  ::kill(child, SIGTERM);
  const Result result = finish(child);
  EXPECT_EQ(result.code, 2);
  expect_words(result.err, {"facet: gone/ck.exr: cannot write: no such folder"});
  EXPECT_TRUE(std::filesystem::exists(folder_.file("a.exr")));
}

TEST_F(CheckpointCliTest, ACheckpointThatCannotBeWrittenDoesNotEndTheRender) {
  std::filesystem::create_directory(folder_.file("gone"));
  const pid_t child = start({"render", "scene.xml", "-o", "a.exr", "--spp", "6000", "--checkpoint",
                             "gone/ck.exr", "--checkpoint-every", "0.01"});
  while (!std::filesystem::exists(folder_.file("gone/ck.exr")))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::filesystem::remove_all(folder_.file("gone"));
  const Result result = finish(child);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder_.file("a.exr")));
}

// The command that info prints ends the render.
TEST_F(CheckpointCliTest, InfoTellsTheCommandThatContinues) {
  const Words options{"--spp", "6000", "--sampler", "sobol", "--crop", "2,3,12,16"};
  ASSERT_EQ(run(with({"render", "scene.xml", "-o", "whole.exr"}, options)).code, 0);
  const pid_t child = start(saved(with({"-o", "a.exr"}, options)));
  ASSERT_TRUE(wait_for_checkpoint(child));
  ::kill(child, SIGTERM);
  ASSERT_EQ(finish(child).code, 130);
  const Result info = run({"info", "ck.exr"});
  ASSERT_EQ(info.code, 0) << info.err;
  expect_words(info.out, {"ck.exr: 10 x 13 pixels from (2, 3) on of 16 x 16", "seed", "of 6000",
                          "a checkpoint, after"});
  std::smatch command;
  ASSERT_TRUE(std::regex_search(info.out, command, std::regex("\n  facet (render .*)\n")));
  const Result again = finish(start_command(
      {"sh", "-c",
       std::string("\"") + FACET_PROGRAM + "\" " +
           std::regex_replace(command[1].str(), std::regex("^render"), "render -o resumed.exr")}));
  EXPECT_EQ(again.code, 0) << again.err;
  expect_words(again.err, {"ck.exr: continued"});
  expect_same_bits(read_exr(folder_.file("resumed.exr")), read_exr(folder_.file("whole.exr")));
}

TEST_F(CheckpointCliTest, InfoTellsOfOtherImages) {
  ASSERT_EQ(run({"render", "scene.xml", "-o", "a.exr", "--sample-range", "0:2"}).code, 0);
  expect_words(run({"info", "a.exr"}).out, {"a part: facet merge joins it"});
  write_exr(folder_.file("b.exr"), Image(2, 3, {"R", "G", "B"}));
  expect_words(run({"info", "b.exr"}).out, {"b.exr: 2 x 3 pixels", "not rendered by facet"});
  expect_failure({"info", "none.exr"}, 2, {"none.exr", "no such file"});
}

}  // namespace
}  // namespace facet::test
