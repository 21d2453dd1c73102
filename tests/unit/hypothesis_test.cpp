// p-values against known ones (30 digits, by arbitrary-precision arithmetic) and against
// identities.
#include "statistics/hypothesis.h"

#include <gtest/gtest.h>

#include <cmath>

namespace facet::statistics {
namespace {

void expect_relative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

TEST(Hypothesis, chi_squared_has_its_known_tails) {
  expect_relative(chi_squared_survival(3.841458820694124, 1), 0.05, 1e-12);
  expect_relative(chi_squared_survival(0.5, 2), 0.778800783071404868, 1e-12);
  expect_relative(chi_squared_survival(255, 255), 0.488222521770406343, 1e-11);
  expect_relative(chi_squared_survival(340, 255), 0.000290124836312723454, 1e-11);
  expect_relative(chi_squared_survival(60, 3), 5.87823072790691234e-13, 1e-11);
  expect_relative(chi_squared_survival(101500, 1e5), 0.000420454971269657067, 1e-7);
  EXPECT_NEAR(chi_squared_survival(100, 255), 1, 1e-13);
  EXPECT_EQ(chi_squared_survival(0, 4), 1);
  EXPECT_EQ(chi_squared_survival(0, 0), 1);
}

TEST(Hypothesis, two_degrees_of_chi_squared_are_exponential) {
  for (double x = 0.01; x < 400; x *= 1.1)
    expect_relative(chi_squared_survival(x, 2), std::exp(-x / 2), 1e-12);
}

TEST(Hypothesis, student_has_its_known_tails) {
  expect_relative(student_p_value(1, 1), 0.5, 1e-13);
  expect_relative(student_p_value(12.706204736432095, 1), 0.0499999999989991306, 1e-12);
  expect_relative(student_p_value(2, 5), 0.101939478829858356, 1e-12);
  expect_relative(student_p_value(4, 1000), 0.0000680099192087815776, 1e-11);
  expect_relative(student_p_value(0.01, 50), 0.992061081367142927, 1e-12);
  expect_relative(student_p_value(30, 20), 4.19522532399965816e-18, 1e-11);
  EXPECT_EQ(student_p_value(INFINITY, 7), 0);
  expect_relative(student_p_value(-2, 5), student_p_value(2, 5), 0);
  EXPECT_EQ(student_p_value(0, 7), 1);
}

TEST(Hypothesis, student_tends_to_the_normal_distribution) {
  for (double z = 0.1; z < 6; z += 0.1)
    expect_relative(student_p_value(z, 1e9), normal_p_value(z), 1e-6);
  expect_relative(normal_p_value(1.959963984540054), 0.05, 1e-12);
}

TEST(Hypothesis, normal_quantiles_are_the_known_ones) {
  expect_relative(two_sided_normal_quantile(0.05), 1.959963984540054, 1e-14);
  expect_relative(two_sided_normal_quantile(1e-9), 6.109410204869002, 1e-12);
  for (double p = 1e-12; p < 1; p *= 3)
    expect_relative(normal_p_value(two_sided_normal_quantile(p)), p, 1e-11);
}

TEST(Hypothesis, independent_tests_err_together_as_often_as_asked) {
  for (const std::uint64_t n : {1ULL, 2ULL, 100ULL, 100000ULL}) {
    EXPECT_NEAR(std::pow(1 - sidak_significance(0.01, n), static_cast<double>(n)), 0.99, 1e-9) << n;
  }
  expect_relative(sidak_significance(0.05, 2), 1 - std::sqrt(0.95), 1e-12);
}

}  // namespace
}  // namespace facet::statistics
