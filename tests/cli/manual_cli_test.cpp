// The manuals made of the table of options, and the self-test's report.
#include "cli/program.h"

namespace facet::test {
namespace {

class ManualCliTest : public CliTest {
 protected:
  /// What bash would complete the last word to.
  [[nodiscard]] std::string completed(const std::string& words, int index) const {
    const std::string script = "source c.sh; COMP_WORDS=(" + words +
                               "); COMP_CWORD=" + std::to_string(index) +
                               "; _facet; echo ${COMPREPLY[@]}";
    const Result result = finish(start_command({"bash", "-c", script}));
    EXPECT_EQ(result.code, 0) << result.err;
    return result.out;
  }
};

TEST_F(ManualCliTest, NamesWhatEveryCommandsHelpNames) {
  const std::string manual = run({"manual", "--form", "markdown"}).out;
  for (const char* command :
       {"render", "merge", "farm-plan", "compare", "bench", "tradeoff", "parity", "test",
        "extremes", "info", "devices", "selftest", "manual"}) {
    const std::string help = run({command, "--help"}).out;
    const std::size_t begin = manual.find("\n## facet " + std::string(command) + "\n");
    ASSERT_NE(begin, std::string::npos) << command;
    const std::string section = manual.substr(begin, manual.find("\n## ", begin + 3) - begin);
    std::istringstream lines(help);
    int options = 0;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t start = line.find("--");
      if (!line.starts_with("  -") || line.find("--help") != std::string::npos) continue;
      const std::string option = line.substr(start, line.find_first_of(" :={", start) - start);
      EXPECT_NE(section.find(option), std::string::npos) << command << ": " << option;
      ++options;
    }
    // The limits at least.
    EXPECT_GE(options, 2) << command;
  }
}

TEST_F(ManualCliTest, ManHasNothingToComplainOf) {
  folder_.write("facet.1", run({"manual", "--form", "man"}).out);
  const Result result = finish(start_command({"sh", "-c",
                                              "command -v groff >/dev/null || exit 77; "
                                              "groff -man -Tutf8 -wall -z facet.1"}));
  if (result.code == 77) GTEST_SKIP() << "needs groff";
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "");
}

TEST_F(ManualCliTest, BashCompletesCommandsOptionsAndWords) {
  folder_.write("c.sh", run({"manual", "--form", "bash"}).out);
  EXPECT_EQ(completed("facet ren", 1), "render\n");
  EXPECT_EQ(completed("facet render --exp", 2), "--exposure\n");
  EXPECT_EQ(completed("facet render --sampling v", 3), "visible\n");
  EXPECT_EQ(completed("facet render --sampling = v", 4), "visible\n");
  EXPECT_EQ(completed("facet render --json = -", 4), "\n");
  EXPECT_EQ(completed("facet render --sampling =", 3), "ndf visible uniform\n");
  EXPECT_EQ(completed("facet compare --max-f", 2), "--max-flip\n");
  // Files are bash's own.
  EXPECT_EQ(completed("facet render sce", 2), "\n");
}

TEST_F(ManualCliTest, SelftestHoldsAndWritesItsReport) {
  const Result result = run({"selftest"});
  EXPECT_EQ(result.code, 0) << result.out << result.err;
  expect_words(result.out,
               {"tested: ", "arithmetic", "furnace", "parity, metals", "parity, paths",
                "same bits again", "Mrays/s", "all 7 checks hold", "report: facet-selftest.txt"});
  std::ostringstream report;
  report << std::ifstream(folder_.file("facet-selftest.txt")).rdbuf();
  EXPECT_EQ(result.out.find(report.str()), 0U);
  EXPECT_EQ(run({"selftest", "-o", "none/r.txt"}).code, 2);
  // A device that cannot be opened is what there is to report.
  EXPECT_EQ(run({"selftest", "--device", "no such device", "-o", "none.txt"}).code, 3);
  std::ostringstream none;
  none << std::ifstream(folder_.file("none.txt")).rdbuf();
  expect_words(none.str(), {"facet ", "FAILED", "no such device"});
}

}  // namespace
}  // namespace facet::test
