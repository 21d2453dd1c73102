// What `facet compare` writes for CI machines: a summary in Markdown, and JUnit XML.
#include <pugixml.hpp>

#include "cli/program.h"
#include "image/files.h"

namespace facet::test {
namespace {

class CompareSummaryCliTest : public CliTest {
 protected:
  /// A gray image whose lower right quarter is so many times as bright.
  void write(const std::string& name, float factor) const {
    Image image(40, 20, {"R", "G", "B"});
    for (int c = 0; c < 3; ++c) {
      for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 40; ++x) image.at(x, y, c) = x >= 20 && y >= 10 ? 0.5F * factor : 0.5F;
      }
    }
    write_exr(folder_.file(name), image);
  }

  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_.file(name)).rdbuf();
    return text.str();
  }

  /// The test cases of a JUnit file, with their failures.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> cases(
      const std::string& name) const {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_file(folder_.file(name).c_str()));
    const pugi::xml_node suite = document.child("testsuites").child("testsuite");
    std::vector<std::pair<std::string, std::string>> list;
    int failures = 0;
    for (const pugi::xml_node one : suite.children("testcase")) {
      const std::string failure = one.child("failure").attribute("message").as_string();
      list.emplace_back(one.attribute("name").as_string(), failure);
      failures += failure.empty() ? 0 : 1;
    }
    EXPECT_EQ(suite.attribute("tests").as_uint(), list.size());
    EXPECT_EQ(suite.attribute("failures").as_int(), failures);
    return list;
  }
};

TEST_F(CompareSummaryCliTest, ASummaryHasVerdictFiguresAndAMap) {
  write("a.exr", 1.05F);
  write("b.exr", 1);
  const Result result =
      run({"compare", "a.exr", "b.exr", "--max-relmse", "1e-6", "--summary", "s.md"});
  EXPECT_EQ(result.code, 1);
  const std::string text = text_of("s.md");
  expect_words(text, {"### ❌ a.exr against b.exr", "above", "| relMSE | 0.000", "🟨"});
  // 24 squares along the longer side; errors of 5 % in the last six rows' right halves alone.
  std::vector<std::string> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("⬜")) rows.push_back(line);
  }
  ASSERT_EQ(rows.size(), 12U);
  const std::string white = "⬜";
  const std::string yellow = "🟨";
  std::string expected;
  for (int i = 0; i < 24; ++i) expected += i < 12 ? white : yellow;
  EXPECT_EQ(rows.back(), expected);
  EXPECT_EQ(rows.front().find(yellow), std::string::npos);
}

TEST_F(CompareSummaryCliTest, SummariesAreAppended) {
  write("a.exr", 1);
  folder_.write("s.md", "before\n");
  for (int i = 0; i < 2; ++i)
    ASSERT_EQ(run({"compare", "a.exr", "a.exr", "--max-abs", "0", "--summary", "s.md"}).code, 0);
  const std::string text = text_of("s.md");
  EXPECT_TRUE(text.starts_with("before\n### ✅"));
  EXPECT_NE(text.find("### ✅", 20), std::string::npos);
  // Without a threshold there is no verdict.
  ASSERT_EQ(run({"compare", "a.exr", "a.exr", "--summary", "t.md"}).code, 0);
  EXPECT_TRUE(text_of("t.md").starts_with("### a.exr"));
}

TEST_F(CompareSummaryCliTest, NamesCommandNoMarkdown) {
  const std::string name = "x](http:evil)<img src=1>|`.exr";
  write(name, 1);
  ASSERT_EQ(run({"compare", name, name, "--summary", "s.md"}).code, 0);
  const std::string text = text_of("s.md");
  for (const char* raw : {"](", "<img", "x|`"}) EXPECT_EQ(text.find(raw), std::string::npos) << raw;
}

TEST_F(CompareSummaryCliTest, JUnitHasACaseAThreshold) {
  write("a.exr", 1.05F);
  write("b.exr", 1);
  EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--max-relmse", "1e-6", "--max-flip", "0.5",
                 "--junit", "r.xml"})
                .code,
            1);
  const auto list = cases("r.xml");
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0], std::pair(std::string("all pixels are finite"), std::string()));
  EXPECT_EQ(list[1].first, "--max-relmse 1e-06");
  expect_words(list[1].second, {"relMSE is", "above"});
  EXPECT_EQ(list[2], std::pair(std::string("--max-flip 0.5"), std::string()));
  EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--junit", "s.xml"}).code, 0);
  EXPECT_EQ(cases("s.xml").size(), 1U);
}

TEST_F(CompareSummaryCliTest, JUnitIsReadableWhateverTheFilesAreCalled) {
  const std::string name = "a\x01\xff\xc3<\".exr";
  write(name, 1);
  ASSERT_EQ(run({"compare", name, name, "--junit", "r.xml", "--summary", "s.md"}).code, 0);
  EXPECT_EQ(cases("r.xml").size(), 1U);
  for (const char* file : {"r.xml", "s.md"}) {
    for (const char byte : {'\x01', '\xff', '\xc3'})
      EXPECT_EQ(text_of(file).find(byte), std::string::npos) << file;
  }
}

TEST_F(CompareSummaryCliTest, NeitherTakesTheImagesPlace) {
  write("a.exr", 1);
  for (const char* option : {"--junit", "--summary"}) {
    const Result result = run({"compare", "a.exr", "a.exr", option, "a.exr"});
    EXPECT_EQ(result.code, 2);
    expect_words(result.err, {"a.exr", "read and written"});
  }
}

}  // namespace
}  // namespace facet::test
