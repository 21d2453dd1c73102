// Renders survive what goes wrong around them: logs that are full, descriptors that are closed, outputs that
// fail, signals.
#include "cli/program.h"
#include "image/files.h"

namespace facet::test {
namespace {

class FaultsCliTest : public CliTest {
 protected:
  /// Runs the program by a shell, with redirections.
  [[nodiscard]] Result run_redirected(const std::string& redirections, const std::string& arguments) const {
    return finish(start_command(
        {"sh", "-c", std::string("exec \"") + FACET_PROGRAM + "\" " + arguments + " " + redirections}));
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
  write_scene(
      "warned.xml",
      floor() + light() + "<emitter type=\"environment\"><float name=\"rotate\" value=\"3\"/></emitter>");
  EXPECT_EQ(run_redirected("2>/dev/full", "render warned.xml -o b.exr").code, 0);
  expect_image("b.exr");
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
  const Result result = finish(start_command(
      {"bash", "-o", "pipefail", "-c",
       std::string("\"") + FACET_PROGRAM + "\" render scene.xml -o a.exr --json - --quiet | true"}));
  EXPECT_TRUE(result.code == 0 || result.code == 2) << result.code;
  expect_image("a.exr");
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

TEST_F(FaultsCliTest, ASignalOfALostTerminalSavesTheImage) {
  const pid_t child = start({"render", "scene.xml", "-o", "a.exr", "--spp", "100000000"});
  // Signals that come before the render watches for them end the program; the file says that it does.
  while (true) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const std::string status = "/proc/" + std::to_string(child) + "/status";
    std::ifstream file(status);
    std::string line;
    while (std::getline(file, line) && !line.starts_with("SigCgt:")) {
    }
    const bool watches =
        line.starts_with("SigCgt:") && (std::stoull(line.substr(8), nullptr, 16) & 1U << (SIGHUP - 1)) != 0;
    if (watches || line.empty()) break;
  }
  ASSERT_EQ(::kill(child, SIGHUP), 0);
  const Result result = finish(child);
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder_.file("a.exr")));
}

}  // namespace
}  // namespace facet::test
