// Our elementary functions over every float of their range.
#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "extremes/function.h"
#include "shared/extreme_inputs.h"

namespace facet::extremes {

namespace {

using namespace shared;

/// The functions themselves, in double or in 160 bits.
template <typename Real>
Real sine_of_turns(Real u, int quarters) {
  using std::cos;
  using std::sin;
  const Real angle = 2 * boost::math::constants::pi<Real>() * (u - Real(quarters) / 4);
  switch (quarters & 3) {
    case 0:
      return sin(angle);
    case 1:
      return cos(angle);
    case 2:
      return -sin(angle);
    default:
      return -cos(angle);
  }
}

/// The nearest multiple of a quarter turn, which leaves an exact difference.
int quarters_of(double u) { return static_cast<int>(std::lround(4 * u)); }

constexpr const char* elementary_group = "elementary functions";
constexpr float infinity = std::numeric_limits<float>::infinity();

void add_exponentials(std::vector<Check>& checks) {
  const auto exponential = [](auto x) {
    using std::exp;
    return exp(x);
  };
  checks.push_back(check_of(elementary_group, "exp", "all floats from -87 to 88", 1.047,
                            of_float(FUNCTION_EXP, exponential),
                            {floats(0, 88), floats(-0.0F, -87)}));
  const auto beyond = [](auto x) {
    using std::exp;
    return x > 0 ? exp(decltype(x)(88)) : decltype(x)(0);
  };
  checks.push_back(check_of(elementary_group, "exp, 0 below -87 and e^88 above 88",
                            "all floats beyond, infinite ones too", 1.05,
                            of_float(FUNCTION_EXP, beyond),
                            {floats(std::nextafter(88.0F, infinity), infinity),
                             floats(std::nextafter(-87.0F, -infinity), -infinity)}));
  const auto logarithm = [](auto x) {
    using std::log;
    return log(x);
  };
  checks.push_back(check_of(
      elementary_group, "log", "all normal floats above 0", 0.83, of_float(FUNCTION_LOG, logarithm),
      {floats(std::numeric_limits<float>::min(), std::numeric_limits<float>::max())}));
}

void add_trigonometry(std::vector<Check>& checks) {
  const auto sine = [](auto u) { return sine_of_turns(u, quarters_of(static_cast<double>(u))); };
  const auto cosine = [](auto u) {
    return sine_of_turns(u + decltype(u)(0.25), quarters_of(static_cast<double>(u)) + 1);
  };
  const auto arctangent = [](auto x) {
    using std::atan;
    return atan(x);
  };
  checks.push_back(check_of(elementary_group, "sin(2 pi u)", "all floats from 0 to 1", 1.81,
                            of_float(FUNCTION_SINE, sine), {floats(0, 1)}));
  checks.push_back(check_of(elementary_group, "cos(2 pi u)", "all floats from 0 to 1", 1.81,
                            of_float(FUNCTION_COSINE, cosine), {floats(0, 1)}));
  checks.push_back(check_of(elementary_group, "atan2(y, 1)", "all finite floats", 2.9,
                            of_float(FUNCTION_ATAN, arctangent),
                            {floats(0, std::numeric_limits<float>::max()),
                             floats(-0.0F, std::numeric_limits<float>::lowest())}));
}

/// The pair of an index, without signs of 0.
std::array<float, 2> pair_of(std::uint32_t index) {
  const uvec4 words = edge_numbers(index);
  return {as_float(words.x) + 0.0F, as_float(words.y) + 0.0F};
}

void add_arctangent_of_two(std::vector<Check>& checks) {
  Function f;
  f.number = FUNCTION_ATAN2;
  f.in_double = [](std::uint32_t index) {
    const auto [y, x] = pair_of(index);
    return std::atan2(static_cast<double>(y), static_cast<double>(x));
  };
  f.exact = [](std::uint32_t index) {
    const auto [y, x] = pair_of(index);
    return Exact(atan2(Exact(y), Exact(x)));
  };
  f.yardstick = [](std::uint32_t index, double value) {
    const auto [y, x] = pair_of(index);
    return std::isfinite(y) && std::isfinite(x) ? ulp_of(value) : -1;
  };
  f.name = [](std::uint32_t index) {
    const uvec4 words = edge_numbers(index);
    return float_text(words.x) + ", " + float_text(words.y);
  };
  checks.push_back(check_of(elementary_group, "atan2(y, x)", "pairs of finite floats at edges", 2.9,
                            f, {{0, 1U << 30U}}));
}

double inverse_erfc(double y) { return boost::math::erfc_inv(y); }

/// By Newton's method from there: each step doubles the digits.
Exact inverse_erfc(const Exact& y) {
  Exact x = inverse_erfc(static_cast<double>(y));
  const Exact root = sqrt(boost::math::constants::pi<Exact>());
  for (int step = 0; step < 4; ++step) x += (erfc(x) - y) * exp(x * x) * root / 2;
  return x;
}

void add_error_functions(std::vector<Check>& checks) {
  // Beside 9.3 squared, exp ends.
  constexpr float last = 9.32F;
  Function complement = of_float(FUNCTION_ERFC, [](auto x) {
    using std::erfc;
    return erfc(x);
  });
  complement.yardstick = [](std::uint32_t word, double value) {
    const double x = as_float(word);
    return value * (1 + x * x);
  };
  Check check = check_of(elementary_group, "erfc", "all floats from -9.32 to 9.32", 5e-7,
                         complement, {floats(0, last), floats(-0.0F, -last)});
  check.unit = "relative error / (1 + x^2)";
  checks.push_back(std::move(check));
  const auto ends = [](auto x) { return decltype(x)(x > 0 ? 0 : 2); };
  checks.push_back(check_of(elementary_group, "erfc, 2 below -9.33 and 0 above 9.33",
                            "all floats beyond, infinite ones too", 0,
                            of_float(FUNCTION_ERFC, ends),
                            {floats(9.33F, infinity), floats(-9.33F, -infinity)}));
  Function quantile = of_float(
      FUNCTION_ERFINV, [](auto u) { return decltype(u)(-inverse_erfc(decltype(u)(2 * u))); });
  quantile.yardstick = [](std::uint32_t /*word*/, double value) { return std::abs(value); };
  const float least = std::ldexp(1.0F, -25);
  const float largest = 1 - std::ldexp(1.0F, -24);
  check = check_of(
      elementary_group, "erfinv(2u - 1)", "all floats from 2^-25 to 1 - 2^-24, but 1/2", 4e-7,
      quantile,
      {floats(least, std::nextafter(0.5F, 0.0F)), floats(std::nextafter(0.5F, 1.0F), largest)});
  check.unit = "relative error";
  checks.push_back(std::move(check));
}

}  // namespace

std::vector<Check> elementary_checks() {
  std::vector<Check> checks;
  add_exponentials(checks);
  add_trigonometry(checks);
  add_arctangent_of_two(checks);
  add_error_functions(checks);
  return checks;
}

}  // namespace facet::extremes
