// `facet extremes`: what it reports, and mistakes. What it finds, tests/extremes see.
#include <nlohmann/json.hpp>

#include "cli/browser.h"
#include "cli/program.h"

namespace facet::test {
namespace {

class ExtremesCliTest : public CliTest {};

TEST_F(ExtremesCliTest, TellsEveryRowInTextJsonAndPage) {
  const Result result = run({"extremes", "--quick", "--only", "a + b,atan2(y", "--json",
                             "report.json", "--html", "page.html"});
  ASSERT_EQ(result.code, 0) << result.out << result.err;
  expect_words(result.out, {"premise", "holds   a + b ", "elementary functions", "atan2(y, 1)",
                            "3 of 3 rows hold, 0 are argued, 0 fail", "a sample of the inputs"});
  const auto report = nlohmann::json::parse(folder_.read("report.json"));
  EXPECT_TRUE(report["complete"].get<bool>());
  EXPECT_TRUE(report["quick"].get<bool>());
  EXPECT_FALSE(report["driver"].get<std::string>().empty());
  ASSERT_EQ(report["rows"].size(), 3U);
  const auto& sum = report["rows"][0];
  EXPECT_EQ(sum["name"], "a + b");
  EXPECT_EQ(sum["worst"], 0);
  EXPECT_EQ(sum["at"], "");
  EXPECT_FALSE(sum["promise"].get<std::string>().empty());
  const auto& arctangent = report["rows"][1];
  EXPECT_EQ(arctangent["unit"], "ulp");
  EXPECT_GT(arctangent["worst"], 0.5);
  EXPECT_LE(arctangent["worst"], arctangent["limit"]);
  EXPECT_GT(arctangent["inputs"], 100000);
  EXPECT_NE(arctangent["at"].get<std::string>().find("(0x"), std::string::npos);
  for (const auto& row : report["rows"]) EXPECT_TRUE(row["holds"].get<bool>());

  const std::string browser = find_browser();
  if (browser.empty()) GTEST_SKIP() << "no chromium to look at the page with";
  const std::string dom = dump_dom(browser, folder_.file("page.html"));
  const std::string page = dom.substr(0, dom.find("<script"));
  expect_words(page,
               {"3 of 3 rows hold, 0 are argued, 0 fail", "premise", "atan2(y, 1)", "(--quick)"});
  for (const char* wrong : {"undefined", "NaN ", "[object"})
    EXPECT_EQ(page.find(wrong), std::string::npos) << wrong;
}

/// The whole table takes hours, and may be lost in any of them.
TEST_F(ExtremesCliTest, KeepsTheRowsUntilItIsKilled) {
  const pid_t child = start({"extremes", "--quick", "--json", "report.json"});
  while (!std::filesystem::exists(folder_.file("report.json")) && ::kill(child, 0) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ASSERT_EQ(::kill(child, SIGKILL), 0);
  EXPECT_EQ(finish(child).code, 1000 + SIGKILL);
  const auto report = nlohmann::json::parse(folder_.read("report.json"));
  EXPECT_FALSE(report["complete"].get<bool>());
  EXPECT_FALSE(report["rows"].empty());
}

TEST_F(ExtremesCliTest, NamesWhatIsWrongWithItsOptions) {
  Result result = run({"extremes", "--only", "no such row"});
  EXPECT_EQ(result.code, 2);
  expect_words(result.err, {"--only no such row: no row has that in its name"});
  result = run({"extremes", "--device", "no such device"});
  EXPECT_EQ(result.code, 3);
  result = run({"extremes", "--quick", "--only", "abs", "--json", "no/such/folder.json"});
  EXPECT_EQ(result.code, 2);
}

}  // namespace
}  // namespace facet::test
