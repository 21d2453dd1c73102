// What the table of extremes measures with: its inputs reach the edges, and its models are the
// definitions of the reference, which is written apart.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "extremes/bench.h"
#include "extremes/bsdf_models.h"
#include "reference/reference_bsdf_evaluator.h"
#include "shared/extreme_inputs.h"

namespace facet::test {
namespace {

using namespace extremes;

TEST(ExtremeInputs, numbers_are_of_every_kind) {
  std::size_t nan = 0;
  std::size_t infinite = 0;
  std::size_t denormal = 0;
  std::size_t zero = 0;
  std::size_t cancelling = 0;
  constexpr std::uint32_t count = 1U << 20U;
  for (std::uint32_t i = 0; i < count; ++i) {
    const shared::uvec4 words = shared::edge_numbers(i);
    const float a = as_float(words.x);
    const float b = as_float(words.y);
    nan += static_cast<std::size_t>(std::isnan(a));
    infinite += static_cast<std::size_t>(std::isinf(a));
    denormal += static_cast<std::size_t>(std::fpclassify(a) == FP_SUBNORMAL);
    zero += static_cast<std::size_t>(a == 0);
    cancelling += static_cast<std::size_t>(std::abs(a + b) < 1e-4F * std::abs(a));
  }
  EXPECT_GT(nan, count / 500);
  EXPECT_GT(infinite, 50U);
  EXPECT_GT(denormal, count / 20);
  EXPECT_GT(zero, 100U);
  EXPECT_GT(cancelling, count / 20);
}

TEST(ExtremeInputs, fractions_end_at_0_and_just_below_1) {
  float least = 1;
  float most = 0;
  std::set<float> etas;
  for (std::uint32_t i = 0; i < 1U << 16U; ++i) {
    const shared::vec4 n = shared::model_numbers(i);
    least = std::min(least, n.x);
    most = std::max(most, n.x);
    EXPECT_TRUE(n.z >= 1e-4F && n.z <= 1) << n.z;
    EXPECT_TRUE(n.w >= 0.25F && n.w <= 4) << n.w;
    etas.insert(n.w);
  }
  EXPECT_EQ(least, 0);
  EXPECT_EQ(most, 1 - 0x1p-24F);
  EXPECT_TRUE(etas.contains(1));
}

TEST(Worst, is_that_of_one_thread) {
  Worst a;
  a.add(7, 2);
  a.add(3, 1);
  Worst b;
  b.add(5, 2);
  b.add(1, -1);
  Worst both = a;
  both.add(b);
  EXPECT_EQ(both.value(), 2);
  EXPECT_EQ(both.word(), 5U) << "the first of equal ones";
  EXPECT_EQ(both.inputs(), 3U) << "what is no input does not count";
  EXPECT_EQ(both.sum(), 5);
  both.add(9, std::nan(""));
  EXPECT_TRUE(std::isinf(both.value()));
  EXPECT_EQ(both.word(), 9U);
}

TEST(ExactModels, are_those_of_the_reference_in_double) {
  for (std::size_t id = 0; id < bsdf_type_names.size(); ++id) {
    std::size_t compared = 0;
    for (const BsdfCase& c : bsdf_cases(id)) {
      // In double too, what is narrower than that is known badly.
      if (c.alpha < 0.01) continue;
      reference::ReferenceBsdfEvaluator<double> reference(c.bsdf, c.sampling);
      Random random(id);
      std::vector<statistics::DirectionPair> pairs;
      for (int i = 0; i < 100; ++i) pairs.push_back(direction_pair(c, random));
      const std::vector<statistics::BsdfValue> values = reference.evaluate(pairs);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const std::optional<ExactValue> right = exact_value(c, pairs[i]);
        if (!right || right->exponent > 20 || right->refracts) continue;
        for (int k = 0; k < 3; ++k) {
          const auto channel = static_cast<std::size_t>(k);
          const auto size = static_cast<double>(right->size.at(channel));
          EXPECT_NEAR(values[i].f[k], static_cast<double>(right->f.at(channel)), 1e-5 * size)
              << bsdf_type_names.at(id) << c.name;
        }
        ++compared;
      }
    }
    EXPECT_GT(compared, 500U) << bsdf_type_names.at(id);
  }
}

}  // namespace
}  // namespace facet::test
