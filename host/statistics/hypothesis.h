#pragma once
// Tests of statistical hypotheses: p-values and how small one must be when many are looked at.
#include <cstdint>

namespace facet::statistics {

/// Probability that chi-squared of so many degrees of freedom is at least `statistic`; 1 without
/// degrees of freedom.
[[nodiscard]] double chi_squared_survival(double statistic, double degrees);

/// Two-sided p-value of Student's t of so many degrees of freedom (Abramowitz and Stegun 26.7.1).
[[nodiscard]] double student_p_value(double t, double degrees);

/// Two-sided p-value of a standard normal deviate.
[[nodiscard]] double normal_p_value(double z);

/// z with P(|N(0, 1)| > z) = p.
[[nodiscard]] double two_sided_normal_quantile(double p);

/// t with P(T <= t) = p for Student's T of so many degrees of freedom; infinite without any.
[[nodiscard]] double student_quantile(double p, double degrees);

/// Significance of each of `tests` independent tests that together err with probability
/// `significance`: 1 - (1 - s)^(1/n) (Z. Šidák, "Rectangular Confidence Regions for the Means of
/// Multivariate Normal Distributions", JASA 62, 1967).
[[nodiscard]] double sidak_significance(double significance, std::uint64_t tests);

}  // namespace facet::statistics
