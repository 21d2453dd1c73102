// Every command that the documentation shows is run as it stands there, but for figures that a test
// has no time for (tests/docs/facet); others are on the list of those that something else runs.
#include <cctype>
#include <regex>

#include "cli/program.h"
#include "docs/pages.h"

namespace facet::test {
namespace {

/// Commands that are not run here, by their beginning, and what runs them instead.
struct ElsewhereCommand {
  const char* beginning;
  const char* by;
};
constexpr ElsewhereCommand elsewhere[] = {
    {"sh cmake/bootstrap.sh", "every run of CI"},
    {"facet bench --growth --quick", "tests/cli/bench_cli_test.cpp"},
    {"facet bench --growth --html growth.html", "tests/cli/bench_cli_test.cpp"},
    {"facet selftest", "tests/cli/manual_cli_test.cpp"},
    {"sh cmake/second-driver.sh", "tests/parity/reproducible_test.cpp"},
    {"sh cmake/release.sh", "the test reproducible_packages, but for the tag"},
    {"apt-get install ./build/packages/", "the test reproducible_packages looks into the packages"},
    {"sh farm/slurm/submit.sh", "tests/farm/slurm_test.cpp"},
    {"seq ", "nobody since it was written down: GNU parallel is no package of the tests"},
    {"mpirun ", "nobody since it was written down: MPI is no package of the tests"},
};

struct Command {
  std::string page;
  int line = 0;
  std::string text;
};

/// The first word of lines that are commands.
bool begins_command(const std::string& text) {
  static const std::regex command(
      R"(^(facet|sh|mkdir|seq|apt-get|docker|mpirun|python3|cmake|ctest|sbatch|parallel)\s.*)");
  return std::regex_match(text, command);
}

std::vector<Command> commands_of(const Page& page) {
  std::vector<Command> commands;
  bool continues = false;
  for (const PageLine& line : read_lines(page)) {
    // What a program prints is fenced as text.
    if (!line.is_code || (!line.language.empty() && line.language != "sh")) continue;
    std::string text = line.text;
    text.erase(0, text.find_first_not_of(' '));
    if (continues)
      commands.back().text += ' ' + text;
    else if (begins_command(text))
      commands.push_back({page.name, line.number, text});
    else
      continue;
    std::string& whole = commands.back().text;
    continues = whole.ends_with('\\');
    if (continues)
      whole.pop_back();
    else
      whole = std::regex_replace(whole, std::regex(R"(\s+(#.*)?$)"), "");
  }
  return commands;
}

bool runs_elsewhere(const Command& command) {
  return std::ranges::any_of(elsewhere, [&](const ElsewhereCommand& other) {
    return command.text.starts_with(other.beginning);
  });
}

/// Whether a page before this one shows the same command, so that it is run there.
bool runs_before(const Command& command) {
  for (const Page& page : all_pages()) {
    if (page.name == command.page) return false;
    if (std::ranges::any_of(commands_of(page),
                            [&](const Command& other) { return other.text == command.text; }))
      return true;
  }
  return false;
}

/// Words in capitals stand for what a reader has.
std::string filled_in(std::string text) {
  text = std::regex_replace(text, std::regex(R"(\bSCENE(\.xml)?\b)"), "scene.xml");
  text = std::regex_replace(text, std::regex(R"(\bNAME\b)"), "llvmpipe");
  return std::regex_replace(text, std::regex("/usr/share/facet/"), "");
}

class DocsCommands : public CliTest, public ::testing::WithParamInterface<std::string> {
 protected:
  /// What the pages' commands expect to find.
  void SetUp() override {
    CliTest::SetUp();
    std::string scene = read_text(folder_.file("scene.xml"));
    scene = std::regex_replace(scene, std::regex("name=\"width\" value=\"16\""),
                               "name=\"width\" value=\"128\"");
    scene = std::regex_replace(scene, std::regex("name=\"height\" value=\"16\""),
                               "name=\"height\" value=\"96\"");
    folder_.write("scene.xml", scene);
    folder_.write("tests.xml", scene);
    for (const char* name : {"references", "parts", "upload"})
      std::filesystem::create_directory(folder_.file(name));
    for (const char* file : {"scene.xml", "floor.obj", "light.obj"})
      std::filesystem::copy(folder_.file(file), folder_.file("upload") / file);
    std::filesystem::create_directory_symlink(page_root() / "scenes", folder_.file("scenes"));
    std::filesystem::copy(page_root() / "scenes/tests/ttest_albedo.xml", folder_.file("tests.xml"),
                          std::filesystem::copy_options::overwrite_existing);
    const auto render = [&](std::vector<std::string> options) {
      options.insert(options.begin(), {"render", "scene.xml", "--quiet"});
      ASSERT_EQ(run(options).code, 0);
    };
    render({"--aov", "variance", "-o", "a.exr"});
    render({"--aov", "variance", "--seed", "1", "-o", "b.exr"});
    std::filesystem::copy(folder_.file("b.exr"), folder_.file("theirs.exr"));
    for (const char* part : {"1/2", "2/2"})
      render({"--part", part, "-o", std::string("parts/") + part[0] + ".exr"});
  }

  static std::string read_text(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  [[nodiscard]] Result shell(const std::string& text) const {
    const std::string path = (page_root() / "tests/docs").string();
    return finish(start_command({"sh", "-c", "PATH='" + path + "':$PATH; " + text},
                                {std::string("FACET_PROGRAM=") + FACET_PROGRAM}));
  }
};

TEST_P(DocsCommands, are_understood) {
  const std::vector<Page> pages = all_pages();
  const auto page = std::ranges::find(pages, GetParam(), &Page::name);
  for (const Command& command : commands_of(*page)) {
    if (runs_elsewhere(command) || runs_before(command)) continue;
    const Result result = shell(filled_in(command.text));
    // A comparison may tell of a difference: that is what it is for.
    const bool compares = command.text.starts_with("facet compare");
    EXPECT_TRUE(result.code == 0 || (compares && result.code == 1))
        << command.page << ":" << command.line << ": " << command.text << ": exit code "
        << result.code << "\n"
        << result.err;
  }
}

std::vector<std::string> pages_with_commands() {
  std::vector<std::string> names;
  for (const Page& page : all_pages()) {
    if (!commands_of(page).empty()) names.push_back(page.name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Pages, DocsCommands, ::testing::ValuesIn(pages_with_commands()),
                         [](const auto& name) {
                           std::string text = name.param;
                           for (char& c : text) {
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           }
                           return text;
                         });

TEST(DocsCommandLists, have_nothing_that_no_page_shows) {
  std::vector<Command> all;
  for (const Page& page : all_pages()) {
    for (const Command& command : commands_of(page)) all.push_back(command);
  }
  EXPECT_GT(all.size(), 50U);
  for (const ElsewhereCommand& other : elsewhere) {
    EXPECT_TRUE(std::ranges::any_of(all, [&](const Command& command) {
      return command.text.starts_with(other.beginning);
    })) << other.beginning;
  }
}

}  // namespace
}  // namespace facet::test
