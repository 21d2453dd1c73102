#include "statistics/hypothesis.h"

#include <algorithm>
#include <cmath>

namespace facet::statistics {

namespace {

constexpr double epsilon = 5e-16;
/// Stands for zero where Lentz's method would divide by it.
constexpr double tiny = 1e-300;

double away_from_zero(double x) { return std::abs(x) < tiny ? tiny : x; }

/// Iterations that suffice: convergence takes about sqrt(a) of them where x is near a.
int iterations(double a) { return 200 + static_cast<int>(20 * std::sqrt(a)); }

/// x^a e^-x / Gamma(a), from logarithms.
double gamma_prefactor(double a, double x) { return std::exp(a * std::log(x) - x - std::lgamma(a)); }

/// P(a, x) by its series, for x < a + 1.
double lower_gamma_series(double a, double x) {
  double term = 1 / a;
  double sum = term;
  for (int k = 1; k < iterations(a) && term > sum * epsilon; ++k) {
    term *= x / (a + k);
    sum += term;
  }
  return sum * gamma_prefactor(a, x);
}

/// A continued fraction b0 + a1/(b1 + a2/(b2 + ...)) by the modified Lentz method (W. Lentz, Applied Optics
/// 15, 1976).
class ContinuedFraction {
 public:
  explicit ContinuedFraction(double b0) : value_(away_from_zero(b0)), c_(value_) {}
  void add(double a, double b) {
    d_ = 1 / away_from_zero(b + a * d_);
    c_ = away_from_zero(b + a / c_);
    change_ = c_ * d_;
    value_ *= change_;
  }
  [[nodiscard]] bool converged() const { return std::abs(change_ - 1) < epsilon; }
  [[nodiscard]] double value() const { return value_; }

 private:
  double value_;
  double c_;
  double d_ = 0;
  double change_ = 0;
};

/// Q(a, x), for x >= a + 1: x^a e^-x / Gamma(a) over (x + 1 - a) + 1 (a - 1)/((x + 3 - a) + ...).
double upper_gamma_fraction(double a, double x) {
  ContinuedFraction fraction(x + 1 - a);
  for (int k = 1; k < iterations(a) && !fraction.converged(); ++k) {
    fraction.add(k * (a - k), x + 2 * k + 1 - a);
  }
  return gamma_prefactor(a, x) / fraction.value();
}

/// log(Gamma(a + b)/Gamma(a)): for large a by Stirling's series, since the logarithms themselves would
/// cancel.
double log_gamma_ratio(double a, double b) {
  if (a < 1e4) return std::lgamma(a + b) - std::lgamma(a);
  return (a - 0.5) * std::log1p(b / a) + b * std::log(a + b) - b + (1 / (a + b) - 1 / a) / 12;
}

/// I_x(a, b) where x is below the mean, and the fraction therefore converges fast.
double incomplete_beta_fraction(double a, double b, double x) {
  ContinuedFraction fraction(1);
  for (int k = 0; k < iterations(a + b) && !fraction.converged(); ++k) {
    fraction.add(-(a + k) * (a + b + k) * x / ((a + 2 * k) * (a + 2 * k + 1)), 1);
    fraction.add((k + 1) * (b - k - 1) * x / ((a + 2 * k + 1) * (a + 2 * k + 2)), 1);
  }
  const double log_beta = std::lgamma(std::min(a, b)) - log_gamma_ratio(std::max(a, b), std::min(a, b));
  return std::exp(a * std::log(x) + b * std::log1p(-x) - log_beta) / (a * fraction.value());
}

}  // namespace

double upper_gamma(double a, double x) {
  if (x <= 0) return 1;
  const double q = x < a + 1 ? 1 - lower_gamma_series(a, x) : upper_gamma_fraction(a, x);
  return std::clamp(q, 0.0, 1.0);
}

double incomplete_beta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  const bool low = x < (a + 1) / (a + b + 2);
  return low ? incomplete_beta_fraction(a, b, x) : 1 - incomplete_beta_fraction(b, a, 1 - x);
}

double chi_squared_survival(double statistic, double degrees) {
  return degrees > 0 ? upper_gamma(0.5 * degrees, 0.5 * statistic) : 1;
}

double student_p_value(double t, double degrees) {
  return incomplete_beta(0.5 * degrees, 0.5, degrees / (degrees + t * t));
}

double normal_p_value(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

double sidak_significance(double significance, std::uint64_t tests) {
  return -std::expm1(std::log1p(-significance) / static_cast<double>(std::max<std::uint64_t>(tests, 1)));
}

}  // namespace facet::statistics
