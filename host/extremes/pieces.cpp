// What models are made of, by their definitions (docs/sampling.md, "Maps"; the sources that
// shaders/lib names): reflectances, microfacet distributions and masking, maps of the unit square.
#include <fmt/format.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "extremes/function.h"
#include "shared/extreme_inputs.h"

namespace facet::extremes {

namespace {

using namespace shared;

constexpr const char* pieces_group = "pieces of models";
/// Inputs of each in a whole measurement.
constexpr WordRange inputs{0, 1U << 24U};

/// What a function may take, of an index.
template <typename Real>
struct Numbers {
  Real a, b, alpha, eta;

  explicit Numbers(std::uint32_t index) {
    const vec4 n = model_numbers(index);
    a = n.x, b = n.y, alpha = n.z, eta = n.w;
  }
};

std::string text_of_numbers(std::uint32_t index) {
  const vec4 n = model_numbers(index);
  return fmt::format("a = {:.9g}, b = {:.9g}, alpha = {:.9g}, eta = {:.9g}", n.x, n.y, n.z, n.w);
}

/// call(numbers) in double and in 160 bits; errors are relative to the value.
template <typename Call>
Function of_numbers(std::uint32_t number, const Call& call) {
  Function f;
  f.number = number;
  f.in_double = [call](std::uint32_t index) { return call(Numbers<double>(index)); };
  f.exact = [call](std::uint32_t index) { return call(Numbers<Exact>(index)); };
  f.yardstick = [](std::uint32_t /*index*/, double value) {
    return std::max(std::abs(value), static_cast<double>(std::numeric_limits<float>::min()));
  };
  f.name = text_of_numbers;
  return f;
}

Check relative_check(const char* name, const char* range, double limit, Function function) {
  Check check = check_of(pieces_group, name, range, limit, std::move(function), {inputs});
  check.unit = "relative error";
  return check;
}

template <typename Real>
Real reflectance(Real cosine, Real eta) {
  using std::sqrt;
  if (eta == 1) return 0;
  const Real cos2 = 1 - (1 - cosine * cosine) / (eta * eta);
  if (cos2 <= 0) return 1;
  const Real beyond = sqrt(cos2);
  const Real s = (cosine - eta * beyond) / (cosine + eta * beyond);
  const Real p = (eta * cosine - beyond) / (eta * cosine + beyond);
  return (s * s + p * p) / 2;
}

/// From Fresnel's amplitudes: with q = sqrt(n^2 - s^2), s the sine, they are (1 - n^2)/(c + q)^2,
/// and that times (c q - s^2)/(c q + s^2).
template <typename Real>
Real conductor_reflectance(Real cosine, Real eta, Real k) {
  using std::abs;
  using std::sqrt;
  if (eta == 1 && k == 0) return 0;
  const Real sin2 = (1 - cosine) * (1 + cosine);
  const Real real = (eta - 1) * (eta + 1) - k * k + cosine * cosine;
  const Real imaginary = 2 * eta * k;
  const Real size = sqrt(real * real + imaginary * imaginary);
  const Real large = sqrt((size + abs(real)) / 2);
  const Real small = large > 0 ? Real(imaginary / (2 * large)) : Real(0);
  const Real p = real >= 0 ? large : small;
  const Real q = real >= 0 ? small : large;
  const auto norm = [](Real x, Real y) { return Real(x * x + y * y); };
  const Real sum = norm(cosine + p, q);
  const Real s = norm(1 - eta, k) * norm(1 + eta, k) / (sum * sum);
  const Real ratio = norm(cosine * p - sin2, cosine * q) / norm(cosine * p + sin2, cosine * q);
  return s * (1 + ratio) / 2;
}

/// As the kernel is given it.
float conductor_k(float b) { return 1000.0F * b * b; }

void add_reflectances(std::vector<Check>& checks) {
  const auto add = [&](const char* name, std::uint32_t function, auto of) {
    Function dielectric =
        of_numbers(function, [of](const auto& n) { return of(reflectance(n.a, n.eta)); });
    // Where the indices are nearly equal, the amplitudes' formula loses digits in double, too; and
    // so does 1 less it.
    dielectric.in_double = [exact = dielectric.exact](std::uint32_t index) {
      return static_cast<double>(exact(index));
    };
    // Beside the critical angle the slope is infinite: what the cosine's rounding would change does
    // not count.
    dielectric.yardstick = [of](std::uint32_t index, double value) {
      const Numbers<double> n(index);
      if (n.eta >= 1) return std::max(value, 1e-30);
      double change = 0;
      for (const double by : {-0x1p-23, 0x1p-23})
        change = std::max(change, std::abs(of(reflectance(n.a * (1 + by), n.eta)) - value));
      return std::max(value + 1e5 * change, 1e-30);
    };
    checks.push_back(relative_check(name,
                                    "cosine a from 0 to 1, index eta from 1/4 to 4, at and near 1 "
                                    "as well; below 1 beside what an ulp of the cosine changes",
                                    1e-5, dielectric));
  };
  add("Fresnel reflectance of a dielectric", FUNCTION_FRESNEL_DIELECTRIC,
      [](const auto& r) { return r; });
  add("Fresnel transmittance of a dielectric", FUNCTION_FRESNEL_TRANSMITTANCE,
      [](const auto& r) { return std::decay_t<decltype(r)>(1 - r); });
  checks.push_back(relative_check("Schlick's reflectance", "cosine a and reflectance b from 0 to 1",
                                  1e-6, of_numbers(FUNCTION_FRESNEL_SCHLICK, [](const auto& n) {
                                    const auto m = 1 - n.a;
                                    return n.b + (1 - n.b) * m * m * m * m * m;
                                  })));
  Function conductor = of_numbers(FUNCTION_FRESNEL_CONDUCTOR, [](const auto& n) {
    using Real = std::decay_t<decltype(n.a)>;
    return conductor_reflectance(n.a, n.eta, Real(conductor_k(static_cast<float>(n.b))));
  });
  // As above: without absorption it is a dielectric.
  conductor.yardstick = [](std::uint32_t index, double value) {
    const Numbers<double> n(index);
    const double k = conductor_k(static_cast<float>(n.b));
    double change = 0;
    for (const double by : {-0x1p-23, 0x1p-23}) {
      const double cosine = std::min(n.a * (1 + by), 1.0);
      change = std::max(change, std::abs(conductor_reflectance(cosine, n.eta, k) - value));
    }
    return std::max(value + 1e5 * change, 1e-30);
  };
  checks.push_back(relative_check(
      "Fresnel reflectance of a conductor",
      "cosine a from 0 to 1, index eta + 1000 b^2 i, eta from 1/4 to 4; beside what an ulp of the "
      "cosine changes",
      1e-5, conductor));
}

/// Squared tangent over squared roughness, of a half vector (a, 0, b).
template <typename Real>
Real exponent(const Numbers<Real>& n) {
  return n.a * n.a / (n.b * n.b * n.alpha * n.alpha);
}

void add_distributions(std::vector<Check>& checks) {
  Function beckmann = of_numbers(FUNCTION_BECKMANN_D, [](const auto& n) {
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
                                  of_numbers(FUNCTION_GGX_D, [](const auto& n) {
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
  checks.push_back(relative_check("Beckmann's G1, rational", range, 1e-5,
                                  of_numbers(FUNCTION_BECKMANN_G1_RATIONAL, [](const auto& n) {
                                    using Real = std::decay_t<decltype(n.a)>;
                                    if (!(n.b > 0)) return Real(0);
                                    if (!(n.b < Real(1.6F) * n.alpha * n.a)) return Real(1);
                                    const Real b = n.b / (n.alpha * n.a);
                                    return Real(
                                        (Real(3535) / 1000 * b + Real(2181) / 1000 * b * b) /
                                        (1 + Real(2276) / 1000 * b + Real(2577) / 1000 * b * b));
                                  })));
  checks.push_back(relative_check(
      "Beckmann's G1, exact", range, 1e-5,
      of_numbers(FUNCTION_BECKMANN_G1_EXACT, [](const auto& n) {
        using Real = std::decay_t<decltype(n.a)>;
        using boost::math::erfc;
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
      relative_check("GGX's G1", range, 1e-5, of_numbers(FUNCTION_GGX_G1, [](const auto& n) {
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
    constexpr std::array all{inputs};
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
    return Finding{worst.inputs(), worst.value(), text_of_numbers(worst.word())};
  };
  return check;
}

/// What a choice leaves of its number (docs/sampling.md, "Choices").
Check quotient_check() {
  Check check =
      make_check(pieces_group, "quotient of 64 bits",
                 "dividends up to the largest, divisors of all sizes", "wrong results", 0);
  check.measure = [](Bench& bench) {
    constexpr std::array all{inputs};
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
  checks.push_back(relative_check(
      "cosine hemisphere, x", range, 1e-6,
      of_numbers(FUNCTION_COSINE_HEMISPHERE_X, [along](const auto& n) { return along(n, 1); })));
  checks.push_back(relative_check(
      "cosine hemisphere, y", range, 1e-6,
      of_numbers(FUNCTION_COSINE_HEMISPHERE_Y, [along](const auto& n) { return along(n, 0); })));
  const auto root = [](const auto& x) {
    using std::sqrt;
    return std::decay_t<decltype(x)>(sqrt(x));
  };
  checks.push_back(relative_check("cosine hemisphere, z", range, 1e-6,
                                  of_numbers(FUNCTION_COSINE_HEMISPHERE_Z, [root](const auto& n) {
                                    return root(std::decay_t<decltype(n.a)>(1 - n.a));
                                  })));
  checks.push_back(relative_check("point of a triangle, u", range, 1e-6,
                                  of_numbers(FUNCTION_TRIANGLE_U, [root](const auto& n) {
                                    using R = std::decay_t<decltype(n.a)>;
                                    return R(root(R(1 - n.a)) * (1 - n.b));
                                  })));
  checks.push_back(relative_check("point of a triangle, v", range, 1e-6,
                                  of_numbers(FUNCTION_TRIANGLE_V, [root](const auto& n) {
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
