// Reflectances, by their definitions (the sources that shaders/lib/fresnel.glsl names).
#include "extremes/pieces.h"

namespace facet::extremes {

namespace {

using namespace shared;

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

}  // namespace

void add_reflectances(std::vector<Check>& checks) {
  const auto add = [&](const char* name, std::uint32_t function, auto of) {
    Function dielectric =
        of_model_numbers(function, [of](const auto& n) { return of(reflectance(n.a, n.eta)); });
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
                                  1e-6,
                                  of_model_numbers(FUNCTION_FRESNEL_SCHLICK, [](const auto& n) {
                                    const auto m = 1 - n.a;
                                    return n.b + (1 - n.b) * m * m * m * m * m;
                                  })));
  Function conductor = of_model_numbers(FUNCTION_FRESNEL_CONDUCTOR, [](const auto& n) {
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

}  // namespace facet::extremes
