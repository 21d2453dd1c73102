// Reconstruction filters against Nori's formulas, and the tables from which offsets are sampled.
#include "scene/filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "render/pack/filter_table.h"

namespace facet {

namespace {

const std::vector<Filter> filters{GaussianFilter{},
                                  GaussianFilter{1, 0.25},
                                  MitchellFilter{},
                                  MitchellFilter{2, 0, 0.5},
                                  MitchellFilter{3, 1, 0},
                                  TentFilter{},
                                  BoxFilter{}};

/// Integral over [a, b] of the filter or of its absolute value.
double integrate(const Filter& filter, double a, double b, bool absolute, int steps = 64) {
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double value = filter_value(filter, a + (b - a) * (i + 0.5) / steps);
    sum += absolute ? std::abs(value) : value;
  }
  return sum * (b - a) / steps;
}

double whole(const Filter& filter, bool absolute) {
  const double radius = filter_radius(filter);
  return integrate(filter, -radius, radius, absolute, 200000);
}

TEST(FilterTest, Gaussian) {
  const GaussianFilter f;
  EXPECT_DOUBLE_EQ(filter_value(f, 0), 1 - std::exp(-8.0));
  EXPECT_DOUBLE_EQ(filter_value(f, -1), std::exp(-2.0) - std::exp(-8.0));
  EXPECT_DOUBLE_EQ(filter_value(f, 0.5), std::exp(-0.5) - std::exp(-8.0));
  EXPECT_EQ(filter_value(f, 2), 0);
  EXPECT_EQ(filter_value(f, 2.5), 0);
  EXPECT_DOUBLE_EQ(filter_value(GaussianFilter{3, 1}, 1), std::exp(-0.5) - std::exp(-4.5));
  EXPECT_EQ(filter_radius(GaussianFilter{3, 1}), 3);
}

TEST(FilterTest, Mitchell) {
  const MitchellFilter f;
  EXPECT_DOUBLE_EQ(filter_value(f, 0), 8.0 / 9);
  EXPECT_NEAR(filter_value(f, 1), 1.0 / 18, 1e-15);
  EXPECT_NEAR(filter_value(f, -1.5), -5.0 / 144, 1e-15);
  EXPECT_NEAR(filter_value(f, 2), 0, 1e-15);
  EXPECT_EQ(filter_value(f, 2.1), 0);
  EXPECT_NEAR(filter_value(MitchellFilter{4, 1.0 / 3, 1.0 / 3}, 2), 1.0 / 18, 1e-15)
      << "stretched to the radius";
  EXPECT_NEAR(filter_value(MitchellFilter{2, 0, 0.5}, 1), 0, 1e-15) << "Catmull-Rom interpolates";
  EXPECT_NEAR(filter_value(MitchellFilter{2, 1, 0}, 0), 2.0 / 3, 1e-15) << "cubic B-spline";
}

TEST(FilterTest, TentAndBox) {
  EXPECT_EQ(filter_value(TentFilter{}, 0), 1);
  EXPECT_EQ(filter_value(TentFilter{}, -0.25), 0.75);
  EXPECT_EQ(filter_value(TentFilter{}, 1.5), 0);
  EXPECT_EQ(filter_radius(TentFilter{}), 1);
  EXPECT_EQ(filter_value(BoxFilter{}, 0.49), 1);
  EXPECT_EQ(filter_value(BoxFilter{}, -0.51), 0);
  EXPECT_EQ(filter_radius(BoxFilter{}), 0.5);
}

TEST(FilterTableTest, QuantilesCoverTheFilterInOrder) {
  for (const Filter& filter : filters) {
    SCOPED_TRACE(filter.index());
    const FilterTable table = make_filter_table(filter);
    ASSERT_GE(table.intervals(), 64U);
    EXPECT_NEAR(table.quantiles.front().x, -filter_radius(filter), 1e-3 * filter_radius(filter));
    EXPECT_FLOAT_EQ(table.quantiles.back().x, static_cast<float>(filter_radius(filter)));
    for (std::size_t i = 1; i < table.quantiles.size(); ++i)
      ASSERT_GE(table.quantiles[i].x, table.quantiles[i - 1].x) << i;
  }
}

TEST(FilterTableTest, QuantilesAreSymmetric) {
  for (const Filter& filter : filters) {
    SCOPED_TRACE(filter.index());
    const FilterTable table = make_filter_table(filter);
    const std::size_t n = table.intervals();
    for (std::size_t i = 0; i <= n; ++i) {
      // Where the filter crosses 0 the offset of a given mass is ill-conditioned.
      ASSERT_NEAR(table.quantiles[i].x, -table.quantiles[n - i].x, 1e-3 * filter_radius(filter))
          << i;
    }
  }
}

TEST(FilterTableTest, IntervalsHaveEqualMass) {
  for (const Filter& filter : filters) {
    SCOPED_TRACE(filter.index());
    const FilterTable table = make_filter_table(filter);
    const double total = whole(filter, true);
    double cumulative = 0;
    for (std::size_t i = 1; i < table.quantiles.size(); ++i) {
      const double mass = integrate(filter, static_cast<double>(table.quantiles[i - 1].x),
                                    static_cast<double>(table.quantiles[i].x), true) /
                          total;
      cumulative += mass;
      ASSERT_NEAR(mass * table.intervals(), 1, 0.01) << i;
      ASSERT_NEAR(cumulative, static_cast<double>(i) / table.intervals(), 1e-5) << i;
    }
  }
}

TEST(FilterTableTest, ValuesAreThoseOfTheFilter) {
  for (const Filter& filter : filters) {
    SCOPED_TRACE(filter.index());
    for (const vec2& q : make_filter_table(filter).quantiles)
      ASSERT_NEAR(q.y, std::abs(filter_value(filter, static_cast<double>(q.x) * (1 - 1e-6))), 1e-4)
          << q.x;
  }
}

TEST(FilterTableTest, ScaleMakesUpForNegativeLobes) {
  for (const Filter& filter : filters) {
    const double expected = whole(filter, true) / whole(filter, false);
    EXPECT_NEAR(make_filter_table(filter).scale, expected, 1e-6) << filter.index();
  }
  EXPECT_GT(make_filter_table(MitchellFilter{}).scale, 1.01F);
  EXPECT_EQ(make_filter_table(BoxFilter{}).scale, 1);
}

TEST(FilterTableTest, CrossingSeparatesTheSigns) {
  for (const Filter& filter : filters) {
    SCOPED_TRACE(filter.index());
    const auto crossing = static_cast<double>(make_filter_table(filter).crossing);
    const double radius = filter_radius(filter);
    for (double x = 0; x < radius; x += radius / 1000) {
      const double value = filter_value(filter, x);
      if (x < crossing - 1e-6 * radius) {
        EXPECT_GE(value, -1e-15) << x;
      }
      if (x > crossing + 1e-6 * radius) {
        EXPECT_LE(value, 1e-15) << x;
      }
    }
  }
}

TEST(FilterTableTest, FiltersWithoutPositiveIntegralAreErrors) {
  EXPECT_THROW((void)make_filter_table(GaussianFilter{2, 1e-300}), InputError);
}

}  // namespace

}  // namespace facet
