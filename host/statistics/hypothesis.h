#pragma once
// Tests of statistical hypotheses: p-values and how small one must be when many are looked at.
#include <cstdint>

namespace facet::statistics {

/// Upper tail Q(a, x) of the regularised incomplete gamma function, a > 0, x >= 0, to about 1e-13 relative
/// (1e-10 for a above 1e5): series below a + 1, Lentz's continued fraction above (Abramowitz and
/// Stegun 6.5.29, 6.5.31).
[[nodiscard]] double upper_gamma(double a, double x);

/// Regularised incomplete beta function I_x(a, b), a, b > 0, x in [0, 1]: Lentz's continued fraction
/// (Abramowitz and Stegun 26.5.8), about 1e-13 relative for moderate a and b.
[[nodiscard]] double incomplete_beta(double a, double b, double x);

/// Probability that chi-squared of so many degrees of freedom is at least `statistic`; 1 without degrees of
/// freedom.
[[nodiscard]] double chi_squared_survival(double statistic, double degrees);

/// Two-sided p-value of Student's t of so many degrees of freedom (Abramowitz and Stegun 26.7.1).
[[nodiscard]] double student_p_value(double t, double degrees);

/// Two-sided p-value of a standard normal deviate.
[[nodiscard]] double normal_p_value(double z);

/// Significance of each of `tests` independent tests that together err with probability `significance`: 1 -
/// (1 - s)^(1/n) (Z. Šidák, "Rectangular Confidence Regions for the Means of Multivariate Normal
/// Distributions", JASA 62, 1967).
[[nodiscard]] double sidak_significance(double significance, std::uint64_t tests);

}  // namespace facet::statistics
