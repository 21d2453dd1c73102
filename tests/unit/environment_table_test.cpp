// The sampling density of environment maps.
#include "render/pack/environment_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/pack/choice.h"

namespace facet {

namespace {

EnvironmentEmitter make_environment(int width, int height, const Color& color = Color(0)) {
  return {width, height,
          std::vector<Color>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                             color)};
}

/// Values between 0 and 10 with black texels among them.
EnvironmentEmitter make_noise(int width, int height) {
  EnvironmentEmitter e = make_environment(width, height);
  std::uint32_t state = 7;
  for (Color& texel : e.texels) {
    state = 1664525U * state + 1013904223U;
    texel = (state >> 28U) < 4 ? Color(0)
                               : Color(10.0F * static_cast<float>(state >> 8U) / 16777216.0F);
  }
  return e;
}

double cell_angle(const EnvironmentTable& table, const EnvironmentEmitter& e, int y) {
  const auto& row = table.rows[static_cast<std::size_t>(y)];
  return 2 * std::numbers::pi / e.width *
         (static_cast<double>(row.y_end) - static_cast<double>(row.y_begin));
}

double density(const EnvironmentTable& table, const EnvironmentEmitter& e, int x, int y) {
  return static_cast<double>(table.texels[static_cast<std::size_t>(y * e.width + x)].w);
}

/// Bilinear luminance at a position in texels, u wrapping and v clamping.
float bilinear(const EnvironmentEmitter& e, double px, double py) {
  const auto texel = [&](int x, int y) {
    const int column = (x % e.width + e.width) % e.width;
    return luminance(
        e.texels[static_cast<std::size_t>(std::clamp(y, 0, e.height - 1) * e.width + column)]);
  };
  const double fx = std::floor(px);
  const double fy = std::floor(py);
  const auto ax = static_cast<float>(px - fx);
  const auto ay = static_cast<float>(py - fy);
  const int x = static_cast<int>(fx);
  const int y = static_cast<int>(fy);
  return (1 - ay) * ((1 - ax) * texel(x, y) + ax * texel(x + 1, y)) +
         ay * ((1 - ax) * texel(x, y + 1) + ax * texel(x + 1, y + 1));
}

TEST(EnvironmentTableTest, RowsReachFromDownToUp) {
  for (const int height : {1, 2, 5, 64}) {
    const EnvironmentTable table =
        make_environment_table(make_environment(3, height, Color(1)), false);
    ASSERT_EQ(table.rows.size(), static_cast<std::size_t>(height));
    EXPECT_EQ(table.rows.front().y_begin, -1);
    EXPECT_EQ(table.rows.back().y_end, 1);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const double expected = -std::cos(std::numbers::pi * static_cast<double>(i) / height);
      EXPECT_NEAR(table.rows[i].y_begin, expected, 1e-7) << i;
      EXPECT_LT(table.rows[i].y_begin, table.rows[i].y_end) << i;
      if (i > 0) {
        EXPECT_EQ(table.rows[i].y_begin, table.rows[i - 1].y_end) << i;
      }
    }
  }
}

TEST(EnvironmentTableTest, DensityIntegratesToOne) {
  for (const auto& e : {make_environment(1, 1, Color(3)), make_noise(16, 8), make_noise(7, 13),
                        make_noise(1, 9), make_noise(9, 1)}) {
    for (const bool compensated : {false, true}) {
      const EnvironmentTable table = make_environment_table(e, compensated);
      double integral = 0;
      for (int y = 0; y < e.height; ++y) {
        for (int x = 0; x < e.width; ++x)
          integral += density(table, e, x, y) * cell_angle(table, e, y);
      }
      EXPECT_NEAR(integral, 1, 1e-5) << e.width << "x" << e.height;
    }
  }
}

TEST(EnvironmentTableTest, AConstantEnvironmentIsUniform) {
  const EnvironmentEmitter e = make_environment(6, 4, Color(2, 3, 4));
  const EnvironmentTable table = make_environment_table(e, false);
  EXPECT_NEAR(table.mean_luminance, luminance(Color(2, 3, 4)), 1e-6);
  for (int y = 0; y < e.height; ++y) {
    for (int x = 0; x < e.width; ++x)
      EXPECT_NEAR(density(table, e, x, y), 0.25 / std::numbers::pi, 1e-7);
  }
}

TEST(EnvironmentTableTest, ACompensatedDensityIsOfWhatExceedsTheMean) {
  const EnvironmentEmitter e = make_noise(8, 6);
  const EnvironmentTable table = make_environment_table(e, true);
  EXPECT_EQ(table.mean_luminance, make_environment_table(e, false).mean_luminance);
  // The mean over the sphere, by midpoints in height and azimuth.
  double mean = 0;
  constexpr int steps = 512;
  for (int j = 0; j < steps; ++j) {
    const double height = (j + 0.5) / steps * 2 - 1;
    // Rows are equal in angle: their coordinate is that from below, 0 to 6.
    const double row = std::acos(-height) / std::numbers::pi * e.height;
    const auto cell_row = std::floor(row);
    // Within a cell the density does not follow the interpolation, so neither does its mean.
    for (int x = 0; x < e.width; ++x)
      mean += static_cast<double>(bilinear(e, x + 0.5, cell_row + 0.5)) / e.width / steps;
  }
  EXPECT_NEAR(table.mean_luminance, mean, 0.01 * mean);
  double scale = 0;
  for (int y = 0; y < e.height; ++y) {
    for (int x = 0; x < e.width; ++x) {
      const double excess =
          static_cast<double>(bilinear(e, x + 0.5, y + 0.5)) - table.mean_luminance;
      if (excess <= 0) {
        EXPECT_EQ(density(table, e, x, y), 0) << x << " " << y;
        continue;
      }
      if (scale == 0) scale = density(table, e, x, y) / excess;
      EXPECT_NEAR(density(table, e, x, y), scale * excess, 1e-5 * scale * excess);
    }
  }
  EXPECT_GT(scale, 0);
}

TEST(EnvironmentTableTest, WithoutAnythingAboveTheMeanNothingIsCompensated) {
  for (const Color& color : {Color(0), Color(0.1F, 0.2F, 0.7F), Color(1e-20F), Color(3e7F)}) {
    const EnvironmentEmitter e = make_environment(7, 5, color);
    const EnvironmentTable plain = make_environment_table(e, false);
    EXPECT_EQ(make_environment_table(e, true).texels, plain.texels);
  }
}

TEST(EnvironmentTableTest, DensityIsTheProbabilityOfTheChoices) {
  const EnvironmentEmitter e = make_noise(8, 5);
  const EnvironmentTable table = make_environment_table(e, false);
  std::vector<std::uint32_t> rows;
  for (const auto& row : table.rows) rows.push_back(row.cumulative);
  for (int y = 0; y < e.height; ++y) {
    const auto columns = std::span(table.columns).subspan(static_cast<std::size_t>(y * e.width), 8);
    for (int x = 0; x < e.width; ++x) {
      const double chosen = choice_probability(rows, static_cast<std::size_t>(y)) *
                            choice_probability(columns, static_cast<std::size_t>(x));
      EXPECT_NEAR(density(table, e, x, y) * cell_angle(table, e, y), chosen, 1e-6);
    }
  }
}

TEST(EnvironmentTableTest, DensityIsPositiveWhereverTheMapIs) {
  for (const int bright : {0, 7, 17, 31}) {
    EnvironmentEmitter e = make_environment(8, 4);
    e.texels[static_cast<std::size_t>(bright)] = Color(1);
    const EnvironmentTable table = make_environment_table(e, false);
    for (int j = 0; j < 8 * e.height; ++j) {
      for (int i = 0; i < 8 * e.width; ++i) {
        if (bilinear(e, (i + 0.5) / 8, (j + 0.5) / 8) > 0) {
          EXPECT_GT(density(table, e, i / 8, j / 8), 0) << i << " " << j;
        }
      }
    }
    EXPECT_EQ(density(table, e, (bright + 4) % 8, bright / 8), 0)
        << "far from the light, no sample is wasted";
  }
}

TEST(EnvironmentTableTest, BrighterTexelsAreChosenMore) {
  EnvironmentEmitter e = make_environment(8, 4, Color(1));
  e.texels[2 * 8 + 3] = Color(100);
  const EnvironmentTable table = make_environment_table(e, false);
  EXPECT_GT(density(table, e, 3, 2), 10 * density(table, e, 0, 2));
  EXPECT_GT(density(table, e, 2, 1), 10 * density(table, e, 0, 1))
      << "interpolation spreads the light";
  EXPECT_LT(density(table, e, 4, 2), density(table, e, 3, 2));
}

TEST(EnvironmentTableTest, MeanLuminanceWeighsBySolidAngle) {
  EnvironmentEmitter e = make_environment(4, 2);
  for (std::size_t i = 4; i < 8; ++i) e.texels[i] = Color(1);
  EXPECT_NEAR(make_environment_table(e, false).mean_luminance, 0.75, 1e-6)
      << "the upper half is 1, the lower rises from 0 to 1";
}

TEST(EnvironmentTableTest, ABlackMapHasNoDensity) {
  const EnvironmentTable table = make_environment_table(make_environment(4, 2), false);
  EXPECT_EQ(table.mean_luminance, 0);
  for (const glm::vec4& texel : table.texels) EXPECT_EQ(texel, glm::vec4(0));
}

}  // namespace

}  // namespace facet
