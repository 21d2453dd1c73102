// Every call of the system and of the device that a render makes may fail. Whichever does, the
// render ends with one line and exit code 2 or 3, or does without what it did not get; what was on
// the disk stays, and no temporary file is left.
//
// Here a sample of each function's calls is refused; with FACET_EVERY_FAULT set, each in turn.
#include <map>
#include <sstream>

#include "cli/program.h"
#include "core/sanitized.h"
#include "image/files.h"

namespace facet::test {
namespace {

using Words = std::vector<std::string>;

class InjectedFaultsCliTest : public CliTest {
 protected:
  void SetUp() override {
    if (is_sanitized) GTEST_SKIP() << "AddressSanitizer has to be the first library";
    CliTest::SetUp();
    inputs_ = folder_.names();
  }

  static Words environment(const std::string& fault) {
    return {"LD_PRELOAD=" FACET_SYSTEM_FAULTS, "VK_INSTANCE_LAYERS=VK_LAYER_FACET_faults",
            "VK_LAYER_PATH=" FACET_FAULT_LAYERS, "FACET_FAULT=" + fault};
  }

  /// All kinds of outputs, and a checkpoint.
  [[nodiscard]] static Words command(const Words& options) {
    Words words{"render", "scene.xml", "-o",      "a.exr",        "-o",    "a.png",
                "--json", "a.json",    "--quiet", "--checkpoint", "ck.exr"};
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }

  void write_old_outputs() const {
    for (const char* name : outputs) folder_.write(name, old);
    std::filesystem::remove(folder_.file("ck.exr"));
  }

  /// How often the render calls each function; also keeps its image.
  std::map<std::string, int> count_calls(const Words& options) {
    Words variables = environment("none:0");
    variables.push_back("FACET_FAULT_COUNTS=" + folder_.file("counts").string());
    write_old_outputs();
    const Result result = run(command(options), variables);
    EXPECT_EQ(result.code, 0) << result.err;
    image_ = folder_.read("a.png");
    std::map<std::string, int> counts;
    std::istringstream text(folder_.read("counts"));
    std::string name;
    for (int count = 0; text >> name >> count;) counts[name] = std::max(counts[name], count);
    std::filesystem::remove(folder_.file("counts"));
    return counts;
  }

  /// Renders with that fault.
  void expect_well_told(const std::string& fault, const Words& options) const {
    SCOPED_TRACE(fault);
    write_old_outputs();
    const Result result = run(command(options), environment(fault));
    if (result.code == 0) {
      EXPECT_EQ(folder_.read("a.png"), image_);
      EXPECT_NE(folder_.read("a.exr"), old);
      EXPECT_NE(folder_.read("a.json"), old);
    } else {
      EXPECT_TRUE(result.code == 2 || result.code == 3) << result.code;
      EXPECT_TRUE(result.err.starts_with("facet: ")) << result.err;
      EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }
    // Each output is as it was, or whole.
    const std::string picture = folder_.read("a.png");
    EXPECT_TRUE(picture == image_ || (picture == old && result.code != 0));
    if (folder_.read("a.exr") != old) {
      EXPECT_EQ(read_image(folder_.file("a.exr")).width(), 16);
    }
    const std::string report = folder_.read("a.json");
    EXPECT_TRUE(report == old || report.ends_with("}\n")) << report;
    for (const std::string& name : folder_.names()) {
      EXPECT_TRUE(std::find(inputs_.begin(), inputs_.end(), name) != inputs_.end() ||
                  std::find(std::begin(outputs), std::end(outputs), name) != std::end(outputs))
          << name << " is left";
    }
  }

  /// Lets calls of the function fail: all of them, or the first, the last and some between.
  void refuse_calls(const std::string& name, int calls, int wanted, const Words& options,
                    const std::string& how = "") const {
    const int step = every_fault() ? 1 : std::max(1, (calls + wanted - 1) / wanted);
    for (int call = 1; call <= calls; call += step)
      expect_well_told(fmt::format("{}:{}{}", name, call, how), options);
    if (calls > 1) expect_well_told(fmt::format("{}:{}{}", name, calls, how), options);
  }

  [[nodiscard]] bool exists(const char* name) const {
    return std::filesystem::exists(folder_.file(name));
  }

  static bool every_fault() { return std::getenv("FACET_EVERY_FAULT") != nullptr; }

  static constexpr const char* outputs[] = {"a.exr", "a.png", "a.json"};
  static constexpr const char* old = "what was there";
  std::vector<std::string> inputs_;
  std::string image_;
};

const Words reference{"--backend", "reference"};

TEST_F(InjectedFaultsCliTest, CallsOfTheDevice) {
  int functions = 0;
  for (const auto& [name, calls] : count_calls({})) {
    if (!name.starts_with("vk") || calls == 0) continue;
    ++functions;
    refuse_calls(name, calls, 2, {});
  }
  EXPECT_GE(functions, 20) << "the layer is not in use";
}

TEST_F(InjectedFaultsCliTest, CallsOfTheSystem) {
  const auto counts = count_calls(reference);
  for (const char* name : {"write", "open", "fsync", "linkat", "rename", "close", "thread"}) {
    ASSERT_GT(counts.at(name), 0) << name;
    refuse_calls(name, counts.at(name), 12, reference);
  }
  // A disk that only reads, and writes that end early.
  refuse_calls("write", counts.at("write"), 3, reference, ":30");
  refuse_calls("open", counts.at("open"), 3, reference, ":30");
  refuse_calls("write", counts.at("write"), 3, reference, ":short");
}

TEST_F(InjectedFaultsCliTest, AllocationsOfTheHost) {
  const auto counts = count_calls(reference);
  ASSERT_GT(counts.at("malloc"), 1000);
  refuse_calls("malloc", counts.at("malloc"), 150, reference);
}

/// What a device needs of the host, its driver's allocations included; drivers may crash then.
TEST_F(InjectedFaultsCliTest, AllocationsBesideADevice) {
  const auto counts = count_calls({});
  const int calls = counts.at("malloc");
  const int step = every_fault() ? 13 : calls / 20;
  for (int call = 1; call <= calls; call += step)
    expect_well_told("malloc:" + std::to_string(call), {});
}

/// A file system that has no files without names gets the old kind of temporary file.
TEST_F(InjectedFaultsCliTest, WithoutFilesThatHaveNoName) {
  (void)count_calls(reference);
  write_old_outputs();
  const std::string unsupported = ":95";
  const Result result = run(command(reference), environment("open:1" + unsupported));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(folder_.read("a.png"), image_);
  for (const std::string& name : folder_.names()) EXPECT_FALSE(name.starts_with(".facet")) << name;
}

/// Suspended machines, and those whose time is set.
TEST_F(InjectedFaultsCliTest, ClocksThatJump) {
  const auto counts = count_calls(reference);
  for (const char* how : {":-1000000000", ":1000000000"})
    refuse_calls("realtime", counts.at("realtime"), 3, reference, how);
  refuse_calls("monotonic", counts.at("monotonic"), 6, reference, ":86400");
  // The time that is left is over at once, and the image of the samples until then is written.
  write_old_outputs();
  Words words = command(reference);
  words.insert(words.end(), {"--spp", "100000000", "--time", "3600"});
  const Result result = run(words, environment("monotonic:20:86400"));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(folder_.read("a.exr"), old);
}

/// Who renders for hours loses the time since the last checkpoint.
TEST_F(InjectedFaultsCliTest, ALostDeviceLosesNoCheckpoint) {
  const Words options{"--spp", "20000", "--sampler", "sobol"};
  const int submits = count_calls(options).at("vkQueueSubmit");
  Words words = command(options);
  words.insert(words.end(), {"--checkpoint-every", "0.01", "--resume"});
  write_old_outputs();
  // Later and later, until a checkpoint has been written before.
  for (int submit = submits / 4; submit < submits && !exists("ck.exr"); submit += submits / 8) {
    const Result result = run(words, environment("vkQueueSubmit:" + std::to_string(submit)));
    ASSERT_EQ(result.code, 3) << result.err;
    EXPECT_NE(result.err.find("DeviceLost"), std::string::npos) << result.err;
    EXPECT_EQ(folder_.read("a.png"), old);
  }
  if (!exists("ck.exr")) GTEST_SKIP() << "this disk is too slow for a checkpoint in these seconds";
  EXPECT_EQ(run(words, environment("vkQueueSubmit:3")).code, 3);
  EXPECT_TRUE(exists("ck.exr"));
  EXPECT_EQ(run(words).code, 0);
  EXPECT_EQ(folder_.read("a.png"), image_);
  EXPECT_FALSE(exists("ck.exr"));
}

/// At every call by which a checkpoint is written.
TEST_F(InjectedFaultsCliTest, KillsInTheWritingOfACheckpointLoseNothing) {
  const Words options{"--spp", "6000", "--sampler", "sobol"};
  (void)count_calls(options);
  Words words = command(options);
  words.insert(words.end(), {"--checkpoint-every", "0.01", "--resume"});
  for (const char* call : {"open:1", "write:1", "write:20", "fsync:1", "linkat:1", "rename:1",
                           "fsync:2", "write:700", "linkat:2", "rename:2"}) {
    SCOPED_TRACE(call);
    write_old_outputs();
    // Where no checkpoint is due yet, the calls are the outputs', and the same holds.
    EXPECT_EQ(run(words, environment(call + std::string(":kill"))).code, 1000 + SIGKILL);
    const Result result = run(words);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(folder_.read("a.png"), image_);
  }
}

/// Each writes a file of its own and then gives it the name.
TEST_F(InjectedFaultsCliTest, TwoProgramsThatWriteOneOutput) {
  (void)count_calls(reference);
  for (int i = 0; i < 5; ++i) {
    write_old_outputs();
    Words words = command(reference);
    words.erase(std::find(words.begin(), words.end(), "--checkpoint"), words.end());
    words.insert(words.end(), reference.begin(), reference.end());
    const pid_t one = start(words);
    const pid_t other = start(words);
    EXPECT_EQ(finish(one).code, 0);
    EXPECT_EQ(finish(other).code, 0);
    EXPECT_EQ(folder_.read("a.png"), image_);
    EXPECT_EQ(read_image(folder_.file("a.exr")).width(), 16);
    EXPECT_TRUE(folder_.read("a.json").ends_with("}\n"));
  }
}

}  // namespace
}  // namespace facet::test
