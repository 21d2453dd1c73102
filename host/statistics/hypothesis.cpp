#include "statistics/hypothesis.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace facet::statistics {

namespace {

namespace math = boost::math;

/// Infinite statistics are values, too; only what is not a number has no probability.
using Policy = math::policies::policy<math::policies::domain_error<math::policies::ignore_error>,
                                      math::policies::overflow_error<math::policies::ignore_error>>;
using ChiSquared = math::chi_squared_distribution<double, Policy>;
using StudentsT = math::students_t_distribution<double, Policy>;
using Normal = math::normal_distribution<double, Policy>;

}  // namespace

double chi_squared_survival(double statistic, double degrees) {
  if (!(degrees > 0) || statistic <= 0) return 1;
  if (std::isinf(statistic)) return 0;
  return math::cdf(math::complement(ChiSquared(degrees), statistic));
}

double student_p_value(double t, double degrees) {
  return std::min(1.0, 2 * math::cdf(math::complement(StudentsT(degrees), std::abs(t))));
}

double normal_p_value(double z) { return 2 * math::cdf(math::complement(Normal(), std::abs(z))); }

double two_sided_normal_quantile(double p) {
  return math::quantile(math::complement(Normal(), p / 2));
}

double student_quantile(double p, double degrees) {
  if (!(degrees > 0)) return std::numeric_limits<double>::infinity();
  return math::quantile(StudentsT(degrees), p);
}

double sidak_significance(double significance, std::uint64_t tests) {
  return -std::expm1(std::log1p(-significance) /
                     static_cast<double>(std::max<std::uint64_t>(tests, 1)));
}

}  // namespace facet::statistics
