// Triangles seen from a point: their solid angle, and points uniformly by it.
#include "reference/emitter/seen_triangle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "statistics/hypothesis.h"

namespace facet::reference {

namespace {

using dvec3 = glm::dvec3;
using Vertices = std::array<dvec3, 3>;

SeenTriangle<double> seen(const Vertices& v, const dvec3& from = dvec3(0)) {
  const dvec3 normal = glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0]));
  return {v[0], v[1], v[2], normal, from};
}

/// Flat, upright, slanted; from near and from afar, and one that fills most of what is above.
const std::vector<Vertices>& triangles() {
  static const std::vector<Vertices> list{
      {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},         {{{-1, -1, 0.5}, {2, -1, 0.5}, {0, 3, 0.5}}},
      {{{3, 0, -1}, {3, 2, -1}, {4, 1, 2}}},       {{{0.1, 0, 1}, {0, 5, 1}, {-0.1, 0, 1}}},
      {{{-30, -30, 1}, {30, -30, 1}, {0, 40, 1}}}, {{{10, 0, 0}, {10, 0.5, 0}, {10, 0, 0.5}}}};
  return list;
}

TEST(SeenTriangle, solid_angles_are_known) {
  EXPECT_NEAR(seen(triangles()[0]).solid_angle(), std::numbers::pi / 2, 1e-14) << "an octant";
  // The square [-1, 1]^2 at a distance of 1: 4 asin(1/2), a sixth of the sphere.
  const double half = seen({{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}}}).solid_angle();
  EXPECT_NEAR(half, std::numbers::pi / 3, 1e-14);
  // Small ones: area by cosine over squared distance.
  const Vertices small{{{3, 4, 0}, {3.001, 4, 0}, {3, 4, 0.001}}};
  EXPECT_NEAR(seen(small).solid_angle(), 0.5e-6 * (4.0 / 5) / 25, 1e-3 * 1.6e-8);
}

TEST(SeenTriangle, a_larger_one_is_the_sum_of_its_parts) {
  for (const Vertices& v : triangles()) {
    const dvec3 inside = 0.2 * v[0] + 0.5 * v[1] + 0.3 * v[2];
    const double sum = seen({v[0], v[1], inside}).solid_angle() +
                       seen({v[1], v[2], inside}).solid_angle() +
                       seen({v[2], v[0], inside}).solid_angle();
    EXPECT_NEAR(seen(v).solid_angle(), sum, 1e-13 + 1e-12 * sum);
  }
}

/// Solid angles of the n^2 similar parts of a triangle, by the place of their rows and columns.
std::vector<double> parts_of(const Vertices& v, int n) {
  const auto corner = [&](int i, int j) {
    const double b = static_cast<double>(i) / n;
    const double c = static_cast<double>(j) / n;
    return (1 - b - c) * v[0] + b * v[1] + c * v[2];
  };
  std::vector<double> parts(static_cast<std::size_t>(2 * n * n), 0);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      const std::size_t at = 2 * (static_cast<std::size_t>(i) * static_cast<std::size_t>(n) +
                                  static_cast<std::size_t>(j));
      parts[at] = seen({corner(i, j), corner(i + 1, j), corner(i, j + 1)}).solid_angle();
      if (i + j + 1 < n)
        parts[at + 1] =
            seen({corner(i + 1, j + 1), corner(i + 1, j), corner(i, j + 1)}).solid_angle();
    }
  }
  return parts;
}

/// Pearson's, with bins of few expected counts pooled.
double p_value(const std::vector<std::uint64_t>& found, const std::vector<double>& expected) {
  double statistic = 0;
  double degrees = -1;
  double pooled_found = 0;
  double pooled_expected = 0;
  const auto add = [&](double count, double mean) {
    statistic += (count - mean) * (count - mean) / mean;
    ++degrees;
  };
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (expected[i] >= 10) {
      add(static_cast<double>(found[i]), expected[i]);
    } else {
      pooled_found += static_cast<double>(found[i]);
      pooled_expected += expected[i];
    }
  }
  if (pooled_expected >= 10) add(pooled_found, pooled_expected);
  return statistics::chi_squared_survival(statistic, degrees);
}

TEST(SeenTriangle, points_are_uniform_by_solid_angle) {
  constexpr int n = 6;
  constexpr int samples = 200000;
  std::mt19937_64 random(1);  // NOLINT(cert-msc51-cpp): the same points each time
  std::uniform_real_distribution<double> number;
  for (const Vertices& v : triangles()) {
    const SeenTriangle<double> triangle = seen(v);
    const std::vector<double> parts = parts_of(v, n);
    std::vector<double> expected(parts.size());
    std::vector<std::uint64_t> found(parts.size(), 0);
    for (std::size_t i = 0; i < parts.size(); ++i)
      expected[i] = samples * parts[i] / triangle.solid_angle();
    for (int k = 0; k < samples; ++k) {
      const double u = number(random);
      const dvec3 b = triangle.point(u, number(random));
      EXPECT_NEAR(b.x + b.y + b.z, 1, 1e-12);
      const double x = std::min(b.y * n, n - 1e-9);
      const double y = std::min(b.z * n, n - 1e-9);
      const auto i = static_cast<std::size_t>(x);
      const auto j = static_cast<std::size_t>(y);
      const bool upper = x - std::floor(x) + y - std::floor(y) > 1;
      ++found[2 * (i * n + j) + (upper ? 1 : 0)];
    }
    EXPECT_GT(p_value(found, expected), statistics::sidak_significance(0.01, triangles().size()));
  }
}

}  // namespace

}  // namespace facet::reference
