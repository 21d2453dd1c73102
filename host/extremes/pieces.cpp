// What models are made of, by their definitions (docs/reference/sampling.md, "Maps"; the sources
// that shaders/lib names): microfacet distributions and masking, maps of the unit square.
#include "extremes/pieces.h"

namespace facet::extremes {

namespace {

using namespace shared;

/// Squared tangent over squared roughness, of a half vector (a, 0, b).
template <typename Real>
Real exponent(const Numbers<Real>& n) {
  return n.a * n.a / (n.b * n.b * n.alpha * n.alpha);
}

void add_distributions(std::vector<Check>& checks) {
  Function beckmann = of_model_numbers(FUNCTION_BECKMANN_D, [](const auto& n) {
    using Real = std::decay_t<decltype(n.a)>;
    using std::exp;
    if (!(n.b > 0) || exponent(n) >= 87) return Real(0);
    const Real secant2 = 1 + n.a * n.a / (n.b * n.b);
    return Real(exp(-exponent(n)) * secant2 * secant2 /
                (boost::math::constants::pi<Real>() * n.alpha * n.alpha));
  });
  beckmann.yardstick = [](std::uint32_t index, double value) {
    const Numbers<double> n(index);
    // Which side of the end of float a rounded exponent is on nothing depends on.
    if (n.b > 0 && std::abs(exponent(n) - 87) < 1e-4) return -1.0;
    return value > 0 ? value * std::max(1.0, exponent(n) / 10) : 1e-30;
  };
  checks.push_back(relative_check(
      "Beckmann's D",
      "half vector (a, 0, b), alpha from 1e-4 to 1; in units of max(1, tan^2/alpha^2/10)", 1e-5,
      beckmann));
  checks.push_back(relative_check("GGX's D", "half vector (a, 0, b), alpha from 1e-4 to 1", 1e-5,
                                  of_model_numbers(FUNCTION_GGX_D, [](const auto& n) {
                                    using Real = std::decay_t<decltype(n.a)>;
                                    if (!(n.b > 0)) return Real(0);
                                    const Real a2 = n.alpha * n.alpha;
                                    const Real tangent2 = n.a * n.a / (n.b * n.b);
                                    const Real sum = (1 + tangent2 / a2) / (1 + tangent2);
                                    return Real(
                                        1 / (boost::math::constants::pi<Real>() * a2 * sum * sum));
                                  })));
}

void add_masking(std::vector<Check>& checks) {
  constexpr const char* range = "direction (a, 0, b), alpha from 1e-4 to 1";
  checks.push_back(
      relative_check("Beckmann's G1, rational", range, 1e-5,
                     of_model_numbers(FUNCTION_BECKMANN_G1_RATIONAL, [](const auto& n) {
                       using Real = std::decay_t<decltype(n.a)>;
                       if (!(n.b > 0)) return Real(0);
                       if (!(n.b < Real(1.6F) * n.alpha * n.a)) return Real(1);
                       const Real b = n.b / (n.alpha * n.a);
                       return Real((Real(3535) / 1000 * b + Real(2181) / 1000 * b * b) /
                                   (1 + Real(2276) / 1000 * b + Real(2577) / 1000 * b * b));
                     })));
  checks.push_back(relative_check(
      "Beckmann's G1, exact", range, 1e-5,
      of_model_numbers(FUNCTION_BECKMANN_G1_EXACT, [](const auto& n) {
        using Real = std::decay_t<decltype(n.a)>;
        using std::erfc;
        using std::exp;
        using std::sqrt;
        if (!(n.b > 0)) return Real(0);
        if (!(n.b < 30 * n.alpha * n.a)) return Real(1);
        const Real b = n.b / (n.alpha * n.a);
        const Real tail = exp(-b * b) / (2 * b * sqrt(boost::math::constants::pi<Real>()));
        return Real(1 / (1 - erfc(b) / 2 + tail));
      })));
  checks.push_back(
      relative_check("GGX's G1", range, 1e-5, of_model_numbers(FUNCTION_GGX_G1, [](const auto& n) {
                       using Real = std::decay_t<decltype(n.a)>;
                       using std::sqrt;
                       if (!(n.b > 0)) return Real(0);
                       const Real t = n.alpha * n.a / n.b;
                       return Real(2 / (1 + sqrt(1 + t * t)));
                     })));
}

/// Cumulative distribution of the visible slopes, not normalised.
double visible_cdf(double s, double c, double x) {
  return c * std::erfc(-x) + s / std::sqrt(boost::math::constants::pi<double>()) * std::exp(-x * x);
}

Check visible_slope_check() {
  Check check =
      make_check(pieces_group, "visible slope, by its distribution",
                 "cosine of view a from 1e-7 to 1, number b from 2^-25 to 1", "error of b", 2e-6);
  check.measure = [](Bench& bench) {
    constexpr std::array all{piece_inputs};
    const Worst worst = bench.sweep(
        Kernel::functions, FUNCTION_VISIBLE_SLOPE, all,
        [](std::uint32_t index, std::uint32_t result) {
          const vec4 n = model_numbers(index);
          const double c = std::max(n.x, 1e-7F);
          const double s = std::sqrt((1 - c) * (1 + c));
          const double upper = std::min(c / std::max(s, 1e-20), 6.0);
          const double u = visible_cdf(s, c, as_float(result)) / visible_cdf(s, c, upper);
          return std::abs(u - static_cast<double>(std::max(n.y, 0x1p-25F)));
        });
    return Finding{worst.inputs(), worst.value(), text_of_model_numbers(worst.word())};
  };
  return check;
}

/// What a choice leaves of its number (docs/reference/sampling.md, "Choices").
Check quotient_check() {
  Check check =
      make_check(pieces_group, "quotient of 64 bits",
                 "dividends up to the largest, divisors of all sizes", "wrong results", 0);
  check.measure = [](Bench& bench) {
    constexpr std::array all{piece_inputs};
    const Worst worst = bench.sweep(
        Kernel::functions, FUNCTION_QUOTIENT, all, [](std::uint32_t index, std::uint32_t result) {
          const uvec4 q = wide_quotient(index);
          const std::uint64_t dividend = (std::uint64_t{q.x} << 32U) + q.y;
          return dividend / q.z == result ? 0.0 : 1.0;
        });
    const uvec4 q = wide_quotient(worst.word());
    return Finding{worst.inputs(), worst.sum(),
                   worst.value() > 0 ? fmt::format("({} 2^32 + {}) / {}", q.x, q.y, q.z) : ""};
  };
  return check;
}

void add_maps(std::vector<Check>& checks) {
  checks.push_back(visible_slope_check());
  // Of a turn, the nearest multiple of a quarter leaves an exact difference.
  const auto along = [](const auto& n, int quarters) {
    using Real = std::decay_t<decltype(n.a)>;
    using std::cos;
    using std::sin;
    using std::sqrt;
    const int nearest = static_cast<int>(std::lround(4 * static_cast<double>(n.b)));
    const Real angle = 2 * boost::math::constants::pi<Real>() * (n.b - Real(nearest) / 4);
    const std::array<Real, 4> of_quarter{sin(angle), cos(angle), -sin(angle), -cos(angle)};
    return Real(sqrt(n.a) * of_quarter.at(static_cast<std::size_t>((nearest + quarters) & 3)));
  };
  constexpr const char* range = "numbers a and b from 0 to 1";
  checks.push_back(
      relative_check("cosine hemisphere, x", range, 1e-6,
                     of_model_numbers(FUNCTION_COSINE_HEMISPHERE_X,
                                      [along](const auto& n) { return along(n, 1); })));
  checks.push_back(
      relative_check("cosine hemisphere, y", range, 1e-6,
                     of_model_numbers(FUNCTION_COSINE_HEMISPHERE_Y,
                                      [along](const auto& n) { return along(n, 0); })));
  const auto root = [](const auto& x) {
    using std::sqrt;
    return std::decay_t<decltype(x)>(sqrt(x));
  };
  checks.push_back(
      relative_check("cosine hemisphere, z", range, 1e-6,
                     of_model_numbers(FUNCTION_COSINE_HEMISPHERE_Z, [root](const auto& n) {
                       return root(std::decay_t<decltype(n.a)>(1 - n.a));
                     })));
  checks.push_back(relative_check("point of a triangle, u", range, 1e-6,
                                  of_model_numbers(FUNCTION_TRIANGLE_U, [root](const auto& n) {
                                    using R = std::decay_t<decltype(n.a)>;
                                    return R(root(R(1 - n.a)) * (1 - n.b));
                                  })));
  checks.push_back(relative_check("point of a triangle, v", range, 1e-6,
                                  of_model_numbers(FUNCTION_TRIANGLE_V, [root](const auto& n) {
                                    using R = std::decay_t<decltype(n.a)>;
                                    return R(root(R(1 - n.a)) * n.b);
                                  })));
}

}  // namespace

std::vector<Check> piece_checks() {
  std::vector<Check> checks;
  add_reflectances(checks);
  add_distributions(checks);
  add_masking(checks);
  add_maps(checks);
  checks.push_back(quotient_check());
  return checks;
}

}  // namespace facet::extremes
