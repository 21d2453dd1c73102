// Every row of `facet extremes --quick`, on the device of the tests.
#include <cctype>

#include "extremes/extremes.h"
#include "support/render.h"

namespace facet::test {
namespace {

class Extremes : public testing::TestWithParam<std::size_t> {};

TEST_P(Extremes, holds) {
  const std::vector<extremes::Check> checks{extremes::all_checks().at(GetParam())};
  const extremes::Table table = extremes::measure(
      kernel_backend(), checks, true,
      [](const extremes::Check& /*check*/, double /*done*/) { return true; },
      [](const extremes::Table& /*so_far*/) {});
  ASSERT_EQ(table.rows.size(), 1U);
  const extremes::Row& row = table.rows.front();
  EXPECT_GT(row.finding.inputs, 0U) << row.check.name << " has tried nothing";
  EXPECT_FALSE(row.fails()) << row.check.name << ": " << row.finding.worst << " of "
                            << row.check.limit << " " << row.check.unit << " at " << row.finding.at;
  expect_silent_validation();
}

/// "premise_a_plus_b": what of the name may be in a test's.
std::string name_of(const testing::TestParamInfo<std::size_t>& info) {
  const extremes::Check check = extremes::all_checks().at(info.param);
  std::string name = fmt::format("row{}", info.param);
  for (const char c : check.group + " " + check.name)
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Rows, Extremes,
                         testing::Range<std::size_t>(0, extremes::all_checks().size()), name_of);

}  // namespace
}  // namespace facet::test
