// The reference's own parts against independent knowledge.
#include <gtest/gtest.h>

#include <random>

#include "reference/bsdf/normal_law.h"
#include "reference/choice.h"
#include "reference/filter.h"
#include "reference/intersect.h"
#include "render/pack/choice.h"
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
    for (const double u :
         {std::ldexp(1.0, -25), 1e-4, 0.1, 0.5, 0.9, 0.9999, 1 - std::ldexp(1.0, -24)}) {
      EXPECT_NEAR(slopes.mass(slopes.quantile(u)) / (u * slopes.mass(end)), 1, 1e-13)
          << polar << ' ' << u;
    }
  }
}

TEST(Reference, choices_are_the_kernels_choices) {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    std::vector<double> weights(1 + random() % 40);
    for (double& w : weights)
      w = random() % 4 == 0
              ? 0
              : std::ldexp(static_cast<double>(random()), -static_cast<int>(random() % 60));
    weights.front() += 1e-30;
    const Choice choice(weights);
    const std::vector<std::uint32_t> cumulative = cumulative_counts(weights);
    for (int k = 0; k < 200; ++k) {
      const auto word = static_cast<std::uint32_t>(random());
      const auto expected =
          std::upper_bound(cumulative.begin(), cumulative.end(), std::min(word, 0xfffffffeU));
      EXPECT_EQ(static_cast<std::ptrdiff_t>(choice.choose(word, 0).entry),
                expected - cumulative.begin());
    }
    for (std::size_t i = 0; i < weights.size(); ++i)
      EXPECT_EQ(choice.probability(i), choice_probability(cumulative, i));
  }
}

// However few words a choice has, what it leaves runs evenly through all of them.
TEST(Reference, a_choice_leaves_a_word) {
  constexpr std::uint32_t last = 0xffffffffU;
  std::mt19937 random(8);
  for (const std::uint64_t n : {1ULL, 2ULL, 3ULL, 1000ULL, 1ULL << 31U, (1ULL << 32U) - 1}) {
    EXPECT_EQ(remainder_of(0, n, 0), 0U);
    EXPECT_EQ(remainder_of(n - 1, n, last), last);
    for (int k = 0; k < 1000; ++k) {
      const std::uint64_t x = random() % n;
      const auto fill = static_cast<std::uint32_t>(random());
      const long double place =
          (static_cast<long double>(x) + static_cast<long double>(fill) / 4294967296.0L) /
          static_cast<long double>(n);
      EXPECT_EQ(remainder_of(x, n, fill),
                static_cast<std::uint32_t>(std::floor(place * 4294967296.0L)));
    }
  }
  const TwoWayChoice choice(0.3);
  const auto words = static_cast<std::uint32_t>(std::ldexp(choice.probability(), 32));
  EXPECT_EQ(choice.remainder(true, 0, 0), 0U);
  EXPECT_EQ(choice.remainder(true, words - 1, last), last);
  EXPECT_EQ(choice.remainder(false, words, 0), 0U);
  EXPECT_EQ(choice.remainder(false, last, last), last);
  EXPECT_EQ(TwoWayChoice(1).remainder(true, 17, 5), 17U) << "there was no choice";
  // A decision that rounding has turned leaves what lies next to it.
  EXPECT_EQ(choice.remainder(true, words + 9, last), last);
  EXPECT_EQ(choice.remainder(false, words - 9, 0), 0U);
}

TEST(Reference, filter_offsets_cut_equal_masses) {
  for (const Filter& filter : {Filter(GaussianFilter{}), Filter(MitchellFilter{}),
                               Filter(TentFilter{}), Filter(BoxFilter{})}) {
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
      EXPECT_NEAR(below[k] / total, (static_cast<double>(k) + 1) / 10, 3e-5)
          << filter.index() << ' ' << k;
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
      const PlaneHit<Real> plane = meet_plane(shear, ray, geometry.triangles[k]);
      if (plane.valid && plane.inside && plane.t > 0 && plane.t < expected.t)
        expected = {plane.t, k, 0, 0};
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
