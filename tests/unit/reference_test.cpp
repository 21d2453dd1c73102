// The reference's own parts against independent knowledge.
#include <gtest/gtest.h>

#include <random>

#include "reference/bsdf/beckmann.h"
#include "reference/bsdf/fresnel.h"
#include "reference/bsdf/roughconductor.h"
#include "reference/bsdf/roughsubstrate.h"
#include "reference/choice.h"
#include "reference/filter.h"
#include "reference/intersect.h"
#include "render/choice.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

using namespace reference;

TEST(Reference, normal_quantile_inverts_erfc) {
  for (int i = 1; i < 4000; ++i) {
    const double u = i < 2000 ? std::ldexp(static_cast<double>(i), -25) : (i - 1999) / 2001.0;
    EXPECT_NEAR(std::erfc(-normal_quantile(u)) / 2, u, 4e-15 * u + 1e-17) << u;
    const auto single = static_cast<double>(normal_quantile(static_cast<float>(u)));
    EXPECT_NEAR(single, normal_quantile(static_cast<double>(static_cast<float>(u))),
                1e-6 * (1 + std::abs(single)))
        << u;
  }
  EXPECT_EQ(normal_quantile(0.5), 0);
}

TEST(Reference, visible_slopes_have_the_mass_that_was_asked_for) {
  for (const double polar : {1e-6, 0.1, 0.7, 1.2, 1.5, 1.5707}) {
    const VisibleSlopes<double> slopes(std::sin(polar), std::cos(polar));
    const double end = std::min(std::cos(polar) / std::sin(polar), 6.0);
    for (const double u : {std::ldexp(1.0, -25), 1e-4, 0.1, 0.5, 0.9, 0.9999, 1 - std::ldexp(1.0, -24)}) {
      EXPECT_NEAR(slopes.mass(slopes.quantile(u)) / (u * slopes.mass(end)), 1, 1e-13) << polar << ' ' << u;
    }
  }
}

/// The integral of a function of direction over the upper hemisphere, by the midpoint rule in tan(theta).
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
      const Vec3<double> w(sine * std::cos(phi), sine * std::sin(phi), cosine);
      // dw = sin(theta) dtheta dphi, dtheta = cos^2 dtan.
      sum += f(w) * sine * cosine * cosine * step * (2 * std::numbers::pi / turns);
    }
  }
  return sum;
}

TEST(Reference, beckmann_normals_and_visible_normals_have_mass_one) {
  Unwatched probe;
  for (const double alpha : {0.01, 0.1, 0.5, 1.0}) {
    const Beckmann<double> microfacets(alpha, LobeSampling::visible);
    const double projected = integrate_hemisphere(
        alpha, [&](const Vec3<double>& h) { return microfacets.density(h, probe) * h.z; });
    EXPECT_NEAR(projected, 1, 1e-5) << alpha;
    for (const double theta : {0.0, 0.8, 1.4, 1.55}) {
      const Vec3<double> wo(std::sin(theta), 0, std::cos(theta));
      const double visible = integrate_hemisphere(alpha, [&](const Vec3<double>& h) {
        return microfacets.exact_masking(wo) * microfacets.density(h, probe) *
               std::max(0.0, glm::dot(wo, h)) / wo.z;
      });
      EXPECT_NEAR(visible, 1, 1e-4) << alpha << ' ' << theta;
    }
  }
}

TEST(Reference, dielectric_reflectance_is_fresnels) {
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
      EXPECT_NEAR(dielectric_reflectance(c, 1.0, to, 0, probe), static_cast<double>(expected), 1e-12);
      EXPECT_NEAR(static_cast<double>(dielectric_reflectance(static_cast<float>(c), 1.0F, index, 0, probe)),
                  static_cast<double>(expected), 2e-4 * static_cast<double>(expected) + 1e-9)
          << to << ' ' << c;
    }
  }
  EXPECT_EQ(dielectric_reflectance(0.3, 1.5, 1.5, 0, probe), 0);
}

// The models written out plainly from their definitions: a misreading that kernels and reference shared would
// show here.
TEST(Reference, bsdf_values_are_their_definitions) {
  Unwatched probe;
  const auto d_of = [](double cos_h, double alpha) {
    const double tan2 = 1 / (cos_h * cos_h) - 1;
    if (tan2 / (alpha * alpha) >= 87) return 0.0;  // docs/sampling.md
    return std::exp(-tan2 / (alpha * alpha)) / (std::numbers::pi * alpha * alpha * std::pow(cos_h, 4));
  };
  const auto g1_of = [](double cosine, double alpha) {
    const double b = 1 / (alpha * std::tan(std::acos(cosine)));
    return b >= 1.6 ? 1 : (3.535 * b + 2.181 * b * b) / (1 + 2.276 * b + 2.577 * b * b);
  };
  const bsdf::RoughConductor metal{Color(0.9F, 0.5F, 0.1F), 0.4F};
  const bsdf::RoughSubstrate paint{Color(0.2F, 0.5F, 0.8F), 0.3F, 1.0F, 1.5F};
  const RoughConductor<double> conductor(metal, LobeSampling::visible);
  const RoughSubstrate<double> substrate(paint, LobeSampling::visible);
  for (const double to : {0.1, 0.7, 1.2, 1.5}) {
    for (const double ti : {0.2, 0.6, 1.1, 1.45}) {
      for (const double phi : {0.0, 1.0, 2.5, 3.1}) {
        const Vec3<double> wo(std::sin(to), 0, std::cos(to));
        const Vec3<double> wi(std::sin(ti) * std::cos(phi), std::sin(ti) * std::sin(phi), std::cos(ti));
        const Vec3<double> h = glm::normalize(wo + wi);
        const double c = glm::dot(h, wi);
        const auto lobe = [&](double alpha) {
          return d_of(h.z, alpha) * g1_of(wi.z, alpha) * g1_of(wo.z, alpha) / (4 * wi.z * wo.z);
        };
        const double ct = std::sqrt(1 - (1 - c * c) / (1.5 * 1.5));
        const double rs = (c - 1.5 * ct) / (c + 1.5 * ct);
        const double rp = (1.5 * c - ct) / (1.5 * c + ct);
        const double base = 28 / (23 * std::numbers::pi) * (1 - 0.04) * (1 - std::pow(1 - wi.z / 2, 5)) *
                            (1 - std::pow(1 - wo.z / 2, 5));
        for (int k = 0; k < 3; ++k) {
          const auto r0 = static_cast<double>(metal.r0[k]);
          const double expected =
              lobe(static_cast<double>(metal.alpha)) * (r0 + (1 - r0) * std::pow(1 - c, 5));
          EXPECT_NEAR(conductor.eval(wo, wi, probe)[k], expected, 1e-9 * expected);
          const double coat = lobe(static_cast<double>(paint.alpha)) * (rs * rs + rp * rp) / 2;
          EXPECT_NEAR(substrate.eval(wo, wi, probe)[k] / (static_cast<double>(paint.kd[k]) * base + coat), 1,
                      1e-9);
        }
      }
    }
  }
}

TEST(Reference, choices_are_the_kernels_choices) {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    std::vector<double> weights(1 + random() % 40);
    for (double& w : weights)
      w = random() % 4 == 0 ? 0 : std::ldexp(static_cast<double>(random()), -static_cast<int>(random() % 60));
    weights.front() += 1e-30;
    const Choice choice(weights);
    const std::vector<std::uint32_t> cumulative = cumulative_counts(weights);
    for (int k = 0; k < 200; ++k) {
      const auto word = static_cast<std::uint32_t>(random());
      const auto expected =
          std::upper_bound(cumulative.begin(), cumulative.end(), std::min(word, 0xfffffffeU));
      EXPECT_EQ(static_cast<std::ptrdiff_t>(choice.choose(word).entry), expected - cumulative.begin());
    }
    for (std::size_t i = 0; i < weights.size(); ++i)
      EXPECT_EQ(choice.probability(i), choice_probability(cumulative, i));
  }
}

TEST(Reference, filter_offsets_cut_equal_masses) {
  for (const Filter& filter :
       {Filter(GaussianFilter{}), Filter(MitchellFilter{}), Filter(TentFilter{}), Filter(BoxFilter{})}) {
    const FilterProfile profile(filter);
    // Mass of |f| below the offset of u, by a fine midpoint rule.
    const double radius = filter_radius(filter);
    constexpr int steps = 200000;
    double total = 0;
    std::array<double, 9> below{};
    for (int i = 0; i < steps; ++i) {
      const double x = radius * (2 * (i + 0.5) / steps - 1);
      const double f = std::abs(filter_value(filter, x));
      total += f;
      for (std::size_t k = 0; k < below.size(); ++k) {
        if (x < profile.offset((static_cast<double>(k) + 1) / 10)) below[k] += f;
      }
    }
    for (std::size_t k = 0; k < below.size(); ++k)
      EXPECT_NEAR(below[k] / total, (static_cast<double>(k) + 1) / 10, 3e-5) << filter.index() << ' ' << k;
  }
}

template <typename Real>
void expect_tree_equals_brute_force() {
  Scene scene = make_scene("depth");
  Mesh ball = make_sphere(4, false);
  transform(ball, 2, {1, -1, 3});
  add_mesh(scene, ball, bsdf::Diffuse{});
  add_mesh(scene, make_quad({-9, -3, -9}, {-9, -3, 9}, {9, -3, 9}, {9, -3, -9}), bsdf::Diffuse{});
  const Geometry<Real> geometry(scene);
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> number(-1, 1);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto vector = [&] {
      const Real x = number(random);
      const Real y = number(random);
      return Vec3<Real>(x, y, number(random));
    };
    Ray<Real> ray{Real(4) * vector(), unit(vector())};
    if (i % 7 == 0) ray.direction = {0, -1, 0};
    const Shear<Real> shear(ray.direction);
    Hit<Real> expected{ray.t_max, none, 0, 0};
    for (std::uint32_t k = 0; k < geometry.triangles.size(); ++k) {
      const PlaneHit<Real> plane = meet_plane(shear, ray.origin, geometry.triangles[k]);
      if (plane.valid && plane.inside && plane.t > 0 && plane.t < expected.t) expected = {plane.t, k, 0, 0};
    }
    const Hit<Real> found = closest_hit(geometry, ray);
    EXPECT_EQ(found.t, expected.t);
    EXPECT_EQ(any_hit(geometry, ray), expected.triangle != none);
    hits += expected.triangle != none ? 1 : 0;
  }
  EXPECT_GT(hits, 500);
}

TEST(Reference, tree_finds_what_brute_force_finds) {
  expect_tree_equals_brute_force<float>();
  expect_tree_equals_brute_force<double>();
}

/// Rays at the vertices and edge midpoints of a closed ball, from inside.
template <typename Real>
void expect_watertight() {
  Scene scene = make_scene("depth");
  Mesh ball = make_sphere(4, true);
  transform(ball, 3, {0.1F, -0.7F, 12});
  add_mesh(scene, ball, bsdf::Diffuse{});
  const Geometry<Real> geometry(scene);
  const Vec3<Real> centre(0.3F, -0.2F, 11.5F);
  std::size_t rays = 0;
  for (const Triangle<Real>& t : geometry.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<Real>& a = t.vertices[k];
      const Vec3<Real>& b = t.vertices[(k + 1) % 3];
      for (const Real share : {Real(0), Real(0.25), Real(0.5)}) {
        const Vec3<Real> target = a * (1 - share) + b * share;
        EXPECT_NE(closest_hit(geometry, {centre, unit(target - centre)}).triangle, none);
        ++rays;
      }
    }
  }
  EXPECT_GT(rays, 10000U);
}

TEST(Reference, closed_meshes_do_not_leak) {
  expect_watertight<float>();
  expect_watertight<double>();
}

}  // namespace
}  // namespace facet::test
