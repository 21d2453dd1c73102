// RMSE, relMSE and their kin against values computed by hand.
#include "compare/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/input.h"

namespace facet {

namespace {

using test::input_error_of;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// An image whose pixels have equal channels.
Image gray(int width, int height, const std::vector<float>& values) {
  Image image(width, height, {"R", "G", "B"});
  for (int c = 0; c < 3; ++c) std::copy(values.begin(), values.end(), image.plane(c));
  return image;
}

Image constant(int width, int height, float value) {
  return gray(width, height, std::vector<float>(static_cast<std::size_t>(width * height), value));
}

TEST(MetricsTest, EqualImagesHaveNoError) {
  const Image image = gray(2, 2, {0, 1, 2, 3e38F});
  const ErrorMetrics m = measure_errors(image, image, 0);
  EXPECT_EQ(m.max_abs, 0);
  EXPECT_EQ(m.rmse, 0);
  EXPECT_EQ(m.relmse, 0);
  EXPECT_EQ(m.relmse_trimmed, 0);
  EXPECT_EQ(m.identical, 4U);
  EXPECT_EQ(m.beyond, 0U);
  EXPECT_TRUE(worst_pixels(m, 10).empty());
}

TEST(MetricsTest, ValuesByHand) {
  Image a = gray(2, 1, {1, 2});
  const Image r = gray(2, 1, {1, 3});
  a.at(0, 0, 2) = 1.5F;
  const ErrorMetrics m = measure_errors(a, r, 0.01);
  // Squares: 0, 0, 0.25 and 1, 1, 1. The reference's mean luminance is 2, so epsilon = 0.02^2.
  EXPECT_DOUBLE_EQ(m.mean_luminance, 2);
  EXPECT_DOUBLE_EQ(m.epsilon(), 4e-4);
  EXPECT_DOUBLE_EQ(m.rmse, std::sqrt(3.25 / 6));
  EXPECT_DOUBLE_EQ(m.terms[0], 0.25 / 1.0004 / 3);
  EXPECT_DOUBLE_EQ(m.terms[1], 1 / 9.0004);
  EXPECT_DOUBLE_EQ(m.relmse, (0.25 / 1.0004 / 3 + 1 / 9.0004) / 2);
  EXPECT_EQ(m.max_abs, 1);
  EXPECT_EQ(m.max_abs_x, 1);
  EXPECT_EQ(m.max_abs_y, 0);
  EXPECT_EQ(m.identical, 0U);
  EXPECT_EQ(m.beyond, 2U);
  EXPECT_DOUBLE_EQ(m.share(m.beyond), 1);
}

TEST(MetricsTest, ErrorsAreRelativeToTheReference) {
  const Image a = gray(1, 1, {1});
  const Image b = gray(1, 1, {2});
  EXPECT_DOUBLE_EQ(measure_errors(a, b, 0).relmse, 1 / (4 + 4e-4));
  EXPECT_DOUBLE_EQ(measure_errors(b, a, 0).relmse, 1 / (1 + 1e-4));
}

TEST(MetricsTest, MeansTellABrighterImageOfPixelsFiniteInBoth) {
  Image a = gray(3, 1, {3, 6, 1000});
  const Image r = gray(3, 1, {2, 4, NAN});
  for (int x = 0; x < 2; ++x) a.at(x, 0, 2) *= 2;
  const ErrorMetrics m = measure_errors(a, r, 0);
  EXPECT_EQ(m.mean_image, glm::dvec3(4.5, 4.5, 9));
  EXPECT_EQ(m.mean_reference, glm::dvec3(3));
  EXPECT_NEAR(m.mean_ratio(), 1.5 + 0.0722 * 1.5, 1e-12);
  EXPECT_EQ(m.mean_change(), 2);
  // No blue in either is no change of it; a red and a green that make up for each other are.
  Image red(1, 1, {"R", "G", "B"});
  Image green = red;
  red.at(0, 0, 0) = 0.7152F;
  green.at(0, 0, 1) = 0.2126F;
  const ErrorMetrics colours = measure_errors(red, green, 0);
  EXPECT_NEAR(colours.mean_ratio(), 1, 1e-7);
  EXPECT_EQ(colours.mean_ratios(), glm::dvec3(INFINITY, 0, 1));
  EXPECT_EQ(colours.mean_change(), INFINITY);
  const Image black = constant(3, 1, 0);
  EXPECT_EQ(measure_errors(black, black, 0).mean_ratio(), 1);
  EXPECT_EQ(measure_errors(black, r, 0).mean_ratio(), 0);
  EXPECT_FALSE(std::isfinite(measure_errors(r, black, 0).mean_ratio()));
  const Image none = constant(3, 1, NAN);
  EXPECT_TRUE(std::isnan(measure_errors(none, none, 0).mean_ratio()));
  EXPECT_TRUE(std::isnan(measure_errors(none, none, 0).mean_change()));
}

TEST(MetricsTest, LuminanceWeighsChannels) {
  Image r(1, 1, {"B", "G", "R"});
  r.at(0, 0, 2) = 1;
  EXPECT_NEAR(measure_errors(r, r, 0).mean_luminance, 0.2126, 1e-15);
  r.at(0, 0, 1) = 1;
  EXPECT_NEAR(measure_errors(r, r, 0).mean_luminance, 0.2126 + 0.7152, 1e-15);
}

TEST(MetricsTest, RelativeErrorHasNoScale) {
  const std::vector<float> reference{0.25F, 1, 3, 0};
  std::vector<float> values{0.5F, 1.25F, 2, 0.0625F};
  const double expected = measure_errors(gray(2, 2, values), gray(2, 2, reference), 0.1).relmse;
  for (const float scale : {0x1p-60F, 0x1p60F}) {
    std::vector<float> scaled_reference = reference;
    std::vector<float> scaled = values;
    for (float& v : scaled_reference) v *= scale;
    for (float& v : scaled) v *= scale;
    const ErrorMetrics m = measure_errors(gray(2, 2, scaled), gray(2, 2, scaled_reference), 0.3);
    EXPECT_NEAR(m.relmse / expected, 1, 1e-12);
    EXPECT_EQ(m.beyond, 3U);
  }
}

TEST(MetricsTest, TrimmingDropsTheThousandthThatIsLargest) {
  std::vector<float> values(2000, 1);
  values[7] = 1001;
  values[1999] = 101;
  values[3] = 2;
  const ErrorMetrics m = measure_errors(gray(50, 40, values), constant(50, 40, 1), 0);
  EXPECT_EQ(m.trimmed, 2U);
  EXPECT_NEAR(m.relmse, (1e6 + 1e4 + 1) / 1.0001 / 2000, 1e-9);
  EXPECT_NEAR(m.relmse_trimmed, 1 / 1.0001 / 1998, 1e-15);
  // A part of a thousandth counts as a whole pixel, but some pixel stays.
  EXPECT_EQ(measure_errors(constant(1001, 1, 1), constant(1001, 1, 1), 0).trimmed, 2U);
  EXPECT_EQ(measure_errors(constant(2, 1, 1), constant(2, 1, 1), 0).trimmed, 1U);
  EXPECT_EQ(measure_errors(constant(1, 1, 1), constant(1, 1, 1), 0).trimmed, 0U);
}

TEST(MetricsTest, PixelsThatAreNotFiniteAreCountedAndLeftOut) {
  const ErrorMetrics m =
      measure_errors(gray(4, 1, {1, NAN, infinity, 2}), gray(4, 1, {1, 1, -infinity, 1}), 0.5);
  EXPECT_EQ(m.nonfinite_image, 2U);
  EXPECT_EQ(m.nonfinite_reference, 1U);
  EXPECT_EQ(m.nonfinite, 2U);
  EXPECT_EQ(m.beyond, 3U);
  EXPECT_EQ(m.identical, 1U);
  EXPECT_DOUBLE_EQ(m.mean_luminance, 1);
  EXPECT_DOUBLE_EQ(m.rmse, std::sqrt(0.5));
  EXPECT_TRUE(std::isnan(m.terms[1]));
  EXPECT_EQ(worst_pixels(m, 10), (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(worst_pixels(m, 1), std::vector<std::size_t>{1});
}

TEST(MetricsTest, WithoutAFinitePixelThereIsNoError) {
  const ErrorMetrics m = measure_errors(gray(1, 1, {NAN}), gray(1, 1, {NAN}), 0);
  EXPECT_EQ(m.nonfinite, 1U);
  EXPECT_EQ(m.identical, 1U) << "a NaN has bits too";
  for (const double error : {m.max_abs, m.rmse, m.relmse, m.relmse_trimmed})
    EXPECT_TRUE(std::isnan(error));
}

TEST(MetricsTest, ABlackReferenceLeavesNoRoom) {
  const ErrorMetrics m = measure_errors(gray(2, 1, {0, 1e-30F}), constant(2, 1, 0), 1e6);
  EXPECT_EQ(m.terms[0], 0);
  EXPECT_EQ(m.relmse, infinity);
  EXPECT_EQ(m.relmse_trimmed, 0);
  EXPECT_EQ(m.beyond, 1U);
  EXPECT_DOUBLE_EQ(measure_errors(constant(2, 1, 0), constant(2, 1, 0), 0).relmse, 0);
}

TEST(MetricsTest, IdenticalMeansBits) {
  const ErrorMetrics m =
      measure_errors(gray(3, 1, {0, 1, 2}), gray(3, 1, {-0.F, std::nextafter(1.F, 2.F), 2}), 1e-6);
  EXPECT_EQ(m.identical, 1U);
  EXPECT_EQ(m.terms[0], 0);
  EXPECT_EQ(m.beyond, 0U);
}

TEST(MetricsTest, TheToleranceIsRelativeWithAFloor) {
  // Mean luminance 1: beyond where |a - r| > 0.1 * (|r| + 0.01).
  const Image r = gray(4, 1, {2, 2, 0, 0});
  const ErrorMetrics m = measure_errors(gray(4, 1, {2.2F, 2.202F, 0.0009F, 0.0011F}), r, 0.1);
  EXPECT_EQ(m.beyond, 2U);
}

TEST(MetricsTest, OnlyLikeRegionsAreCompared) {
  const auto message = [](const Image& a, const Image& b) {
    return input_error_of([&] { return check_comparable(a, "a.exr", b, "b.exr"), 0; });
  };
  EXPECT_EQ(message(constant(2, 3, 0), constant(3, 2, 0)),
            "a.exr is 2x3 pixels, b.exr is 3x2: only like regions can be compared");
  Image crop = constant(2, 3, 0);
  crop.window = {4, 5, 8, 8};
  EXPECT_NE(message(crop, constant(2, 3, 0)).find("2x3 at (4, 5) of 8x8"), std::string::npos);
  EXPECT_NE(message(Image(2, 3, {"Y"}), constant(2, 3, 0)).find("a.exr: has no channel R"),
            std::string::npos);
  EXPECT_NE(message(constant(2, 3, 0), Image(2, 3, {"R", "G"})).find("b.exr: has no channel B"),
            std::string::npos);
  check_comparable(crop, "a.exr", crop, "b.exr");
}

}  // namespace

}  // namespace facet
