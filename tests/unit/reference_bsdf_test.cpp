// Values of the reference's BSDFs: against their definitions, written out plainly, and against what
// physics says of them.
#include <gtest/gtest.h>

#include "extremes/bsdf_models.h"
#include "support/bsdfs.h"

namespace facet::test {
namespace {

using namespace reference;
using Direction = Vec3<double>;

/// The integral of a function of direction over the upper hemisphere, by the midpoint rule in
/// tan(theta).
template <typename Function>
double integrate_hemisphere(double scale, const Function& f) {
  constexpr int steps = 2000;
  constexpr int turns = 200;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    // t/(1-t) maps to all slopes, densest near `scale`.
    const double t = (i + 0.5) / steps;
    const double tangent = scale * t / (1 - t);
    const double step = scale / ((1 - t) * (1 - t)) / steps;
    const double cosine = 1 / std::sqrt(1 + tangent * tangent);
    const double sine = tangent * cosine;
    for (int k = 0; k < turns; ++k) {
      const double phi = 2 * std::numbers::pi * (k + 0.5) / turns;
      const Direction w(sine * std::cos(phi), sine * std::sin(phi), cosine);
      // dw = sin(theta) dtheta dphi, dtheta = cos^2 dtan.
      sum += f(w) * sine * cosine * cosine * step * (2 * std::numbers::pi / turns);
    }
  }
  return sum;
}

TEST(ReferenceBsdf, normals_and_visible_normals_have_mass_one) {
  Unwatched probe;
  for (const bsdf::MicrofacetOptions& options : {rational_beckmann, ggx}) {
    for (const double alpha : {0.01, 0.1, 0.5, 1.0}) {
      const Microfacets<double> microfacets(alpha, options, LobeSampling::visible);
      const double projected = integrate_hemisphere(
          alpha, [&](const Direction& h) { return microfacets.density(h, probe) * h.z; });
      EXPECT_NEAR(projected, 1, 1e-5) << alpha;
      for (const double theta : {0.0, 0.8, 1.4, 1.55}) {
        const Direction wo = direction(theta, 0);
        const double visible = integrate_hemisphere(alpha, [&](const Direction& h) {
          return microfacets.exact_masking(wo) * microfacets.density(h, probe) *
                 std::max(0.0, glm::dot(wo, h)) / wo.z;
        });
        EXPECT_NEAR(visible, 1, 1e-4) << alpha << ' ' << theta;
      }
    }
  }
}

TEST(ReferenceBsdf, densities_know_no_length) {
  Unwatched probe;
  for (const bsdf::MicrofacetOptions& options : {rational_beckmann, ggx}) {
    const Microfacets<float> microfacets(0.01F, options, LobeSampling::visible);
    const Vec3<float> h(0.01F, -0.005F, 0.9F);
    const float d = microfacets.density(h, probe);
    EXPECT_GT(d, 1);
    for (const float length : {1e-7F, 0.125F, 2.0F})
      EXPECT_NEAR(microfacets.density(h * length, probe) / d, 1, 1e-5);
  }
}

// B. Walter et al. 2007 say 0.35 %.
TEST(ReferenceBsdf, rational_masking_is_near_the_exact_one) {
  Unwatched probe;
  double largest = 0;
  for (const double alpha : {0.05, 0.3, 1.0}) {
    const Microfacets<double> rational(alpha, rational_beckmann, LobeSampling::visible);
    const Microfacets<double> exact(alpha, exact_beckmann, LobeSampling::visible);
    for (double cosine = 1e-4; cosine < 1; cosine += 1e-3) {
      const Direction w = direction(std::acos(cosine), 0.3);
      const double g = exact.masking({0, 0, 1}, w, probe);
      EXPECT_EQ(g, exact.exact_masking(w));
      largest = std::max(largest, std::abs(rational.masking({0, 0, 1}, w, probe) / g - 1));
    }
  }
  EXPECT_LE(largest, 0.0035);
  EXPECT_GE(largest, 0.002) << "they are two functions";
}

TEST(ReferenceBsdf, dielectric_reflectance_is_fresnels) {
  Unwatched probe;
  for (const float index : {1.0001F, 1.33F, 2.4F, 0.5F, 0.99F}) {
    const auto to = static_cast<double>(index);
    for (const double c : {1.0, 0.9, 0.5, 0.1, 1e-3, 1e-7}) {
      const long double ratio = 1 / static_cast<long double>(to);
      const long double sin2 = ratio * ratio * (1 - static_cast<long double>(c) * c);
      long double expected = 1;
      if (sin2 < 1) {
        const long double ct = std::sqrt(1 - sin2);
        const long double s = (c - to * ct) / (c + to * ct);
        const long double p = (to * c - ct) / (to * c + ct);
        expected = (s * s + p * p) / 2;
      }
      EXPECT_NEAR(dielectric_shares(c, 1.0, to, 0, probe).reflected, static_cast<double>(expected),
                  1e-12);
      EXPECT_NEAR(static_cast<double>(
                      dielectric_shares(static_cast<float>(c), 1.0F, index, 0, probe).reflected),
                  static_cast<double>(expected), 2e-4 * static_cast<double>(expected) + 1e-9)
          << to << ' ' << c;
      // To its own digits where nearly all is reflected.
      const auto passed = static_cast<double>(1 - expected);
      EXPECT_NEAR(dielectric_shares(c, 1.0, to, 0, probe).transmitted, passed, 1e-11 * passed)
          << to << ' ' << c;
    }
  }
  EXPECT_EQ(dielectric_shares(0.3, 1.5, 1.5, 0, probe).reflected, 0);
  EXPECT_EQ(dielectric_shares(0.3, 1.5, 1.5, 0, probe).transmitted, 1);
}

TEST(ReferenceBsdf, conductor_reflectance_is_fresnels) {
  // At normal incidence ((eta - 1)^2 + k^2)/((eta + 1)^2 + k^2); aluminium and gold in green.
  for (const auto& [eta, k] : {std::pair{0.9, 6.7}, {0.35, 2.7}, {3.0, 0.1}}) {
    const double expected = ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
    EXPECT_NEAR(conductor_reflectance(eta, k, 1.0), expected, 1e-12);
    EXPECT_NEAR(conductor_reflectance(eta, k, 1e-9), 1, 1e-6);
    // Away from it, by the textbook's amplitudes.
    for (const double c : {0.9, 0.5, 0.1}) {
      const std::complex<double> n(eta, k);
      const std::complex<double> ct = std::sqrt(1.0 - (1 - c * c) / (n * n));
      const double s = std::norm((c - n * ct) / (c + n * ct));
      const double p = std::norm((n * c - ct) / (n * c + ct));
      EXPECT_NEAR(conductor_reflectance(eta, k, c), (s + p) / 2, 1e-12);
      EXPECT_NEAR(conductor_reflectance(static_cast<float>(eta), static_cast<float>(k),
                                        static_cast<float>(c)),
                  (s + p) / 2, 1e-5);
    }
  }
  Unwatched probe;
  for (const double c : {1.0, 0.6, 0.2}) {
    for (const double eta : {1.5, 0.7})
      EXPECT_NEAR(conductor_reflectance(eta, 0.0, c),
                  dielectric_shares(c, 1.0, eta, 0, probe).reflected, 1e-12);
  }
}

/// Calls check(wo, wi) for pairs on all sides; above: only for pairs above.
template <typename Check>
void for_each_pair(bool above, const Check& check) {
  const std::vector<double> angles{0.1, 0.7, 1.2, 1.5, 1.65, 2.0, 2.6, 3.0};
  const std::size_t count = above ? 4 : 8;
  for (std::size_t o = 0; o < count; ++o) {
    for (std::size_t i = 0; i < count; ++i) {
      for (const double phi : {0.0, 1.0, 2.5, 3.1})
        check(direction(angles[o], 0), direction(angles[i] + 0.05, phi));
    }
  }
}

TEST(ReferenceBsdf, values_are_their_definitions) {
  Unwatched probe;
  for (const bsdf::MicrofacetOptions& options : {rational_beckmann, exact_beckmann, ggx}) {
    for (const NamedBsdf& b : rough_bsdfs(0.4F, options)) {
      extremes::BsdfCase model_case;
      model_case.bsdf = b.bsdf;
      int positive = 0;
      for_each_pair(b.name != "roughdielectric", [&](const Direction& wo, const Direction& wi) {
        const auto model = make_bsdf<double>(b.bsdf, LobeSampling::visible, wo.z < 0);
        const statistics::DirectionPair pair{vec3(wo), vec3(wi)};
        const std::optional<extremes::ExactValue> expected = exact_value(model_case, pair);
        const Direction value = model.eval(Direction(pair.wo), Direction(pair.wi), probe);
        for (std::size_t k = 0; k < 3; ++k) {
          const auto f = static_cast<double>(expected->f.at(k));
          // Beckmann's distribution ends at e^-87 (docs/reference/sampling.md).
          const double lost = expected->exponent >= 87 ? 1e-34 : 0;
          EXPECT_NEAR(value[static_cast<int>(k)], f, 1e-6 * f + lost) << b.name;
          positive += f > lost ? 1 : 0;
        }
      });
      EXPECT_GE(positive, 150) << b.name;
    }
  }
}

TEST(ReferenceBsdf, light_may_run_backwards) {
  Unwatched probe;
  for (const bsdf::MicrofacetOptions& options : {rational_beckmann, exact_beckmann, ggx}) {
    for (const NamedBsdf& b : rough_bsdfs(0.3F, options, 1, 1.7F)) {
      for_each_pair(b.name != "roughdielectric", [&](const Direction& wo, const Direction& wi) {
        const auto there = make_bsdf<double>(b.bsdf, LobeSampling::visible, wo.z < 0);
        const auto back = make_bsdf<double>(b.bsdf, LobeSampling::visible, wi.z < 0);
        // f(wo, wi)/eta_o^2 is symmetric.
        const double scale = (wi.z > 0 ? 1 : 1.7) / (wo.z > 0 ? 1 : 1.7);
        const double f = there.eval(wo, wi, probe).x * scale * scale;
        EXPECT_NEAR(back.eval(wi, wo, probe).x, f, 1e-6 * f) << b.name;
      });
    }
  }
}

TEST(ReferenceBsdf, opaque_surfaces_are_black_from_below) {
  Unwatched probe;
  for (const NamedBsdf& b : rough_bsdfs(0.5F, ggx)) {
    const auto model = make_bsdf<double>(b.bsdf, LobeSampling::visible);
    EXPECT_EQ(model.transmits(), b.name == "roughdielectric");
    if (model.transmits()) continue;
    EXPECT_EQ(model.eval(direction(0.5, 0), direction(1.6, 1), probe), Direction(0)) << b.name;
    EXPECT_EQ(model.pdf(direction(0.5, 0), direction(1.6, 1), probe), 0) << b.name;
  }
}

// What a conductor without loss reflects is all of the light, with the light that bounces between
// microfacets: to a thousandth, which the bounces of a closed room multiply.
TEST(ReferenceBsdf, multiscatter_gives_back_what_is_lost) {
  Unwatched probe;
  for (const bsdf::MicrofacetOptions& options : {rational_beckmann, exact_beckmann, ggx}) {
    for (const float alpha : {0.1F, 0.37F, 1.0F}) {
      for (const double theta : {0.1, 1.27, 1.5}) {
        const Direction wo = direction(theta, 0);
        const auto albedo = [&](bool multiscatter) {
          const Bsdf metal = bsdf::RoughConductor{Color(1), alpha, options, multiscatter};
          const auto model = make_bsdf<double>(metal, LobeSampling::visible);
          // Over half vectors, among which no lobe is narrow: dwi = 4 (wo.h) dh.
          return integrate_hemisphere(alpha, [&](const Direction& h) {
            const double cosine = glm::dot(wo, h);
            const Direction wi = 2 * cosine * h - wo;
            return cosine > 0 && wi.z > 0 ? model.eval(wo, wi, probe).x * wi.z * 4 * cosine : 0.0;
          });
        };
        EXPECT_NEAR(albedo(true), 1, 0.001) << alpha << ' ' << theta;
        if (alpha < 1) continue;
        EXPECT_LT(albedo(false), 0.98) << alpha << ' ' << theta;
      }
    }
  }
}

}  // namespace
}  // namespace facet::test
