// Discrete choices by 32-bit words.
#include "render/pack/choice.h"

#include <gtest/gtest.h>

#include <limits>

namespace facet {

namespace {

constexpr std::uint32_t all = std::numeric_limits<std::uint32_t>::max();

std::uint32_t words_of(const std::vector<std::uint32_t>& cumulative, std::size_t i) {
  return cumulative[i] - (i > 0 ? cumulative[i - 1] : 0);
}

TEST(ChoiceTest, ASingleEntryTakesEveryWord) {
  for (const double weight : {1.0, 1e-300, 1e300})
    EXPECT_EQ(cumulative_counts(std::vector{weight}), std::vector{all}) << weight;
}

TEST(ChoiceTest, NothingToChoose) {
  EXPECT_TRUE(cumulative_counts({}).empty());
  EXPECT_EQ(cumulative_counts(std::vector{0.0, 0.0}), (std::vector<std::uint32_t>{0, 0}));
}

TEST(ChoiceTest, ProbabilitiesAreProportionalToWeights) {
  const std::vector<double> weights{3, 1, 0.25, 7, 0, 2.5};
  const auto cumulative = cumulative_counts(weights);
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    EXPECT_NEAR(choice_probability(cumulative, i), weights[i] / 13.75, 4e-9) << i;
    sum += choice_probability(cumulative, i);
  }
  EXPECT_DOUBLE_EQ(sum, 1);
}

TEST(ChoiceTest, ZeroWeightsHaveNoWord) {
  const auto cumulative = cumulative_counts(std::vector{0.0, 1.0, 0.0, 0.0, 5.0, 0.0});
  for (const std::size_t i : {0U, 2U, 3U, 5U}) EXPECT_EQ(words_of(cumulative, i), 0U) << i;
  EXPECT_EQ(cumulative[4], all) << "the last positive weight takes the rest";
  EXPECT_EQ(cumulative[5], all);
}

TEST(ChoiceTest, PositiveWeightsHaveAWordHoweverSmall) {
  const std::vector<double> weights{1e-300, 1,     1e-30, std::numeric_limits<double>::denorm_min(),
                                    1e10,   1e-300};
  const auto cumulative = cumulative_counts(weights);
  for (std::size_t i = 0; i < weights.size(); ++i) EXPECT_GE(words_of(cumulative, i), 1U) << i;
  EXPECT_EQ(cumulative.back(), all);
}

TEST(ChoiceTest, ManyWeightsStayInOrder) {
  std::vector<double> weights(100000);
  for (std::size_t i = 0; i < weights.size(); ++i)
    weights[i] = i % 7 == 0 ? 0 : 1.0 / static_cast<double>(1 + i % 1000);
  const auto cumulative = cumulative_counts(weights);
  EXPECT_EQ(cumulative.back(), all);
  for (std::size_t i = 1; i < weights.size(); ++i) {
    ASSERT_GE(cumulative[i], cumulative[i - 1]) << i;
    ASSERT_EQ(words_of(cumulative, i) > 0, weights[i] > 0) << i;
  }
}

TEST(ChoiceTest, EqualWeightsGetEqualCounts) {
  const auto cumulative = cumulative_counts(std::vector<double>(1000, 0.1));
  for (std::size_t i = 0; i < cumulative.size(); ++i)
    EXPECT_NEAR(words_of(cumulative, i), all / 1000.0, 1.5) << i;
  EXPECT_EQ(cumulative.back(), all);
}

}  // namespace

}  // namespace facet
