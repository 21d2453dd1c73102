// Renders survive what goes wrong around them: logs that are full, descriptors that are closed,
// outputs that fail, signals.
#include "cli/program.h"
#include "core/sanitized.h"
#include "image/files.h"

namespace facet::test {
namespace {

class FaultsCliTest : public CliTest {
 protected:
  /// Runs the program by a shell, with redirections.
  [[nodiscard]] Result run_redirected(const std::string& redirections,
                                      const std::string& arguments) const {
    return finish(start_command(
        {"sh", "-c",
         std::string("exec \"") + FACET_PROGRAM + "\" " + arguments + " " + redirections}));
  }
  void expect_image(const std::string& name) const {
    const Image image = read_image(folder_.file(name));
    EXPECT_EQ(image.width(), 16);
    float largest = 0;
    for (int i = 0; i < 256; ++i) largest = std::max(largest, image.plane(0)[i]);
    EXPECT_GT(largest, 0);
  }
};

TEST_F(FaultsCliTest, AFullLogLosesNoImage) {
  EXPECT_EQ(run_redirected("2>/dev/full", "render scene.xml -o a.exr").code, 0);
  expect_image("a.exr");
  // Warnings come before the render, from the reader.
  write_scene("warned.xml",
              floor() + light() +
                  "<emitter type=\"environment\"><float name=\"rotate\" value=\"3\"/></emitter>");
  EXPECT_EQ(run_redirected("2>/dev/full", "render warned.xml -o b.exr").code, 0);
  expect_image("b.exr");
}

TEST_F(FaultsCliTest, ExtensionsMayBeInCapitals) {
  EXPECT_EQ(run({"render", "scene.xml", "-o", "a.EXR", "-o", "b.Png"}).code, 0);
  EXPECT_EQ(image_format(folder_.file("a.EXR")), ImageFormat::exr);
  EXPECT_EQ(image_format(folder_.file("b.Png")), ImageFormat::png);
  EXPECT_EQ(run({"compare", "a.EXR", "b.Png"}).code, 0);
}

TEST_F(FaultsCliTest, ClosedDescriptorsLoseNoImage) {
  for (const char* closed : {"2>&-", ">&-", "<&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
    std::filesystem::remove(folder_.file("a.exr"));
    EXPECT_EQ(run_redirected(closed, "render scene.xml -o a.exr").code, 0) << closed;
    expect_image("a.exr");
  }
}

TEST_F(FaultsCliTest, AFullStandardOutputIsAnError) {
  const Result result = run_redirected(">/dev/full", "render scene.xml -o a.exr --json -");
  EXPECT_EQ(result.code, 2);
  expect_words(result.err, {"cannot write to standard output"});
  expect_image("a.exr");
}

TEST_F(FaultsCliTest, AReaderThatHasGoneLosesNoImage) {
  const Result result =
      finish(start_command({"bash", "-o", "pipefail", "-c",
                            std::string("\"") + FACET_PROGRAM +
                                "\" render scene.xml -o a.exr --json - --quiet | true"}));
  EXPECT_TRUE(result.code == 0 || result.code == 2) << result.code;
  expect_image("a.exr");
}

/// As by the quota of a batch system, wherever in the file it is reached.
TEST_F(FaultsCliTest, FilesThatGrowTooLargeAreErrors) {
  ASSERT_EQ(run({"render", "scene.xml", "-o", "a.exr", "-o", "a.png", "--resolution", "64x64",
                 "--seed", "1"})
                .code,
            0);
  for (const std::string name : {"a.exr", "a.png"}) {
    const std::string before = folder_.read(name);
    const std::size_t blocks = before.size() / 512;
    ASSERT_GT(blocks, 1U);
    for (std::size_t b = 1; b <= blocks; b += std::max<std::size_t>(1, blocks / 5)) {
      const Result result =
          finish(start_command({"sh", "-c",
                                "ulimit -f " + std::to_string(b) + "; exec \"" + FACET_PROGRAM +
                                    "\" render scene.xml --quiet --resolution 64x64 -o " + name}));
      EXPECT_EQ(result.code, 2) << b;
      EXPECT_EQ(result.err, "facet: " + name + ": cannot write: File too large\n");
      EXPECT_EQ(folder_.read(name), before);
    }
  }
}

TEST_F(FaultsCliTest, AnOutputThatFailsDoesNotLoseTheOthers) {
  std::filesystem::create_symlink("/dev/full", folder_.file("full.exr"));
  const Result result =
      run({"render", "scene.xml", "-o", "full.exr", "-o", "good.exr", "-o", "good.png", "--quiet"});
  EXPECT_EQ(result.code, 2);
  expect_words(result.err, {"/dev/full", "cannot write: No space left on device"});
  expect_image("good.exr");
  expect_image("good.png");
}

/// Waits until the render watches for signals: those that come before end the program.
void wait_until_it_watches(pid_t child) {
  while (true) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    std::ifstream file("/proc/" + std::to_string(child) + "/status");
    std::string line;
    while (std::getline(file, line) && !line.starts_with("SigCgt:")) {
    }
    const bool watches = line.starts_with("SigCgt:") &&
                         (std::stoull(line.substr(8), nullptr, 16) & 1U << (SIGHUP - 1)) != 0;
    if (watches || line.empty()) return;
  }
}

TEST_F(FaultsCliTest, ASignalOfALostTerminalSavesTheImage) {
  const pid_t child = start({"render", "scene.xml", "-o", "a.exr", "--spp", "100000000"});
  wait_until_it_watches(child);
  ASSERT_EQ(::kill(child, SIGHUP), 0);
  const Result result = finish(child);
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder_.file("a.exr")));
}

TEST_F(FaultsCliTest, ALostFolderLosesNoImage) {
  std::filesystem::create_directory(folder_.file("gone"));
  const pid_t child =
      start({"render", "scene.xml", "-o", "gone/a.exr", "--json", "a.json", "--spp", "100000000"});
  wait_until_it_watches(child);
  std::filesystem::remove(folder_.file("gone"));
  ASSERT_EQ(::kill(child, SIGTERM), 0);
  const Result result = finish(child);
  EXPECT_EQ(result.code, 130) << result.err;
  expect_words(result.err, {"warning: gone/a.exr: no such folder any more", "wrote a.exr\n"});
  expect_words(folder_.read("a.json"), {"\"output\": [\n    \"a.exr\"\n  ]"});
  EXPECT_TRUE(std::filesystem::exists(folder_.file("a.exr")));
}

/// As a driver's that gets no memory.
TEST_F(FaultsCliTest, ACrashIsToldAndLeavesNothing) {
  if (is_sanitized) GTEST_SKIP() << "the sanitizer tells of crashes";
  folder_.write("a.exr", "what was there");
  const auto names = folder_.names();
  const pid_t child = start({"render", "scene.xml", "-o", "a.exr", "--spp", "100000000"});
  wait_until_it_watches(child);
  ASSERT_EQ(::kill(child, SIGSEGV), 0);
  const Result result = finish(child);
  EXPECT_EQ(result.code, 3);
  EXPECT_NE(result.err.find("facet: crashed"), std::string::npos) << result.err;
  EXPECT_EQ(folder_.read("a.exr"), "what was there");
  EXPECT_EQ(folder_.names(), names);
}

TEST_F(FaultsCliTest, NoInputIsWritten) {
  write_png(folder_.file("map.png"), Image(1, 1, {"R", "G", "B"}), 0);
  write_exr(folder_.file("sky.exr"), Image(1, 1, {"R", "G", "B"}));
  write_scene(
      "scene.xml",
      mesh("floor.obj",
           "<bsdf type=\"diffuse\"><texture type=\"textmap\" name=\"albedo\"><string "
           "name=\"filename\" "
           "value=\"map.png\"/></texture></bsdf>") +
          light() +
          "<emitter type=\"environment\"><string name=\"filename\" value=\"sky.exr\"/></emitter>");
  std::filesystem::create_hard_link(folder_.file("sky.exr"), folder_.file("linked.exr"));
  const std::string sky = folder_.read("sky.exr");
  expect_failure({"render", "scene.xml", "-o", "./sky.exr"}, 2, {"sky.exr", "read and written"});
  expect_failure({"render", "scene.xml", "-o", "linked.exr"}, 2,
                 {"linked.exr", "read and written"});
  expect_failure({"render", "scene.xml", "-o", "map.png"}, 2, {"map.png", "read and written"});
  expect_failure({"render", "scene.xml", "-o", "a.exr", "--json", "scene.xml"}, 2,
                 {"scene.xml", "read and written"});
  expect_failure({"parity", "scene.xml", "--json", "light.obj"}, 2,
                 {"light.obj", "read and written"});
  expect_failure({"bench", "scene.xml", "--html", "scene.xml"}, 2,
                 {"scene.xml", "read and written"});
  folder_.write("test.xml", "<test type=\"chi2test\"><bsdf type=\"diffuse\"/></test>");
  expect_failure({"test", "test.xml", "--junit", "test.xml"}, 2, {"test.xml", "read and written"});
  expect_failure({"test", "test.xml", "--junit", "a", "--json", "a"}, 2, {"a", "written twice"});
  EXPECT_EQ(folder_.read("sky.exr"), sky);
}

TEST_F(FaultsCliTest, OptionsRescueScenesOfUnknownIntegratorsAndSamplers) {
  folder_.write("unknown.xml", "<scene>\n" + camera() + R"(
<sampler type="halton"><integer name="sampleCount" value="4"/></sampler>
<integrator type="photonmapper"><integer name="photonCount" value="1000"/></integrator>
)" + floor() + light() + "</scene>");
  expect_failure({"render", "unknown.xml", "-o", "a.exr", "--integrator", "path_mis"}, 2,
                 {"unknown.xml:3", "halton"});
  expect_failure({"render", "unknown.xml", "-o", "a.exr", "--sampler", "sobol"}, 2,
                 {"unknown.xml:4", "photonmapper"});
  const Result result = run({"render", "unknown.xml", "-o", "a.exr", "--integrator", "path_mis",
                             "--sampler", "sobol", "--quiet"});
  EXPECT_EQ(result.code, 0) << result.err;
  expect_words(result.err, {"unknown.xml:3", "replaced by --sampler", "unknown.xml:4",
                            "replaced by --integrator"});
  expect_image("a.exr");
}

}  // namespace
}  // namespace facet::test
