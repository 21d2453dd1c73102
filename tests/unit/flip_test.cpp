// FLIP against its definition: values derived by hand, an independent computation, and what must
// hold for any image.
#include "compare/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/input.h"

namespace facet {

namespace {

Image constant(int width, int height, float red, float green, float blue) {
  Image image(width, height, {"R", "G", "B"});
  const float values[3] = {red, green, blue};
  for (int c = 0; c < 3; ++c) std::fill_n(image.plane(c), width * height, values[c]);
  return image;
}

/// Channel values ((i x + j y + k c) mod m) / (m - 1).
Image pattern(int i, int j, int k, int m) {
  Image image(12, 10, {"R", "G", "B"});
  for (int c = 0; c < 3; ++c) {
    for (int y = 0; y < 10; ++y) {
      for (int x = 0; x < 12; ++x)
        image.at(x, y, c) =
            static_cast<float>((i * x + j * y + k * c) % m) / static_cast<float>(m - 1);
    }
  }
  return image;
}

Image test_image() { return pattern(37, 61, 17, 101); }
Image reference_image() { return pattern(53, 29, 71, 97); }

template <typename Function>
Image mapped(Image image, const Function& f) {
  for (int c = 0; c < 3; ++c)
    std::transform(image.plane(c), image.plane(c) + image.width() * image.height(), image.plane(c),
                   f);
  return image;
}

/// 20 v^4, which spreads values over many stops.
Image bright(const Image& image) {
  return mapped(image, [](float v) { return 20 * v * v * v * v; });
}

void expect_in_unit_range(const FlipResult& result) {
  for (const float v : result.map) {
    EXPECT_GE(v, 0);
    EXPECT_LE(v, 1);
  }
}

TEST(FlipTest, EqualImagesDoNotDiffer) {
  const Image image = test_image();
  EXPECT_EQ(flip(image, image).largest, 0);
  EXPECT_EQ(hdr_flip(bright(image), bright(image)).largest, 0);
}

TEST(FlipTest, BlackAgainstWhite) {
  // Constant images have no features and pass the filters unchanged. HyAB of black and white is dL
  // = 100; the largest, of green (L* 87.7365, a* -86.1822, b* 83.1798) and blue (32.3009, 79.1939,
  // -107.8554), each chroma times L*/100, is 55.4356 + |(-101.1937, 107.8175)| = 203.30; to the
  // power 0.7: 25.1189 and 41.276. Beyond 0.4 * 41.276 = 16.510 the difference is 0.95 + 0.05
  // (25.1189 - 16.510) / (41.276 - 16.510) = 0.96738.
  const FlipResult result = flip(constant(8, 8, 0, 0, 0), constant(8, 8, 1, 1, 1));
  EXPECT_NEAR(result.mean, 0.96738, 1e-5);
  EXPECT_NEAR(result.largest, result.mean, 1e-6);
}

TEST(FlipTest, BlackAgainstGray) {
  // L* of 0.5 is 116 cbrt(0.5) - 16 = 76.069; of 0.001, 116 (0.001 * 841 / 108 + 4 / 29) - 16 =
  // 0.9033.
  const double bend = 0.4 * 41.2761;
  for (const auto& [value, lightness] : {std::pair(0.5F, 76.0693), std::pair(0.001F, 0.90330)}) {
    const double d = std::pow(lightness, 0.7);
    const double expected =
        d < bend ? 0.95 * d / bend : 0.95 + 0.05 * (d - bend) / (41.2761 - bend);
    EXPECT_NEAR(flip(constant(4, 4, 0, 0, 0), constant(4, 4, value, value, value)).mean, expected,
                2e-5)
        << value;
  }
}

TEST(FlipTest, GreenAgainstBlueIsTheLargestDifference) {
  EXPECT_NEAR(flip(constant(4, 4, 0, 1, 0), constant(4, 4, 0, 0, 1)).mean, 1, 1e-5);
}

TEST(FlipTest, AgreesWithADirectComputation) {
  // Expected values: a separate program that convolves with the papers' two-dimensional kernels in
  // double.
  const FlipResult ldr = flip(test_image(), reference_image());
  EXPECT_NEAR(ldr.mean, 0.303461904, 2e-6);
  EXPECT_NEAR(ldr.map[0], 0.642899948, 5e-6);
  EXPECT_NEAR(ldr.map[4 * 12 + 5], 0.305302007, 5e-6);
  EXPECT_NEAR(ldr.map[9 * 12 + 11], 0.406913918, 5e-6);
  EXPECT_NEAR(ldr.largest, 0.642899948, 5e-6);
  const HdrFlipResult hdr = hdr_flip(bright(test_image()), bright(reference_image()));
  EXPECT_EQ(hdr.exposures, 3);
  EXPECT_NEAR(hdr.start_exposure, -2.797560923, 1e-6);
  EXPECT_NEAR(hdr.stop_exposure, -0.179239371, 1e-6);
  EXPECT_NEAR(hdr.mean, 0.345830739, 2e-6);
  EXPECT_NEAR(hdr.map[0], 0.756069349, 5e-6);
  EXPECT_NEAR(hdr.map[4 * 12 + 5], 0.331513370, 5e-6);
  EXPECT_NEAR(hdr.map[9 * 12 + 11], 0.568734364, 5e-6);
}

TEST(FlipTest, IsSymmetricAndWithinItsRange) {
  const FlipResult forward = flip(test_image(), reference_image());
  const FlipResult backward = flip(reference_image(), test_image());
  EXPECT_EQ(forward.map, backward.map);
  expect_in_unit_range(forward);
  expect_in_unit_range(hdr_flip(bright(test_image()), bright(reference_image())));
}

TEST(FlipTest, TurnsWithTheImage) {
  const auto transposed = [](const Image& image) {
    Image result(image.height(), image.width(), image.channels());
    for (int c = 0; c < 3; ++c) {
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) result.at(y, x, c) = image.at(x, y, c);
      }
    }
    return result;
  };
  const FlipResult upright = flip(test_image(), reference_image());
  const FlipResult turned = flip(transposed(test_image()), transposed(reference_image()));
  for (std::size_t y = 0; y < 10; ++y) {
    for (std::size_t x = 0; x < 12; ++x)
      EXPECT_NEAR(upright.map[y * 12 + x], turned.map[x * 10 + y], 2e-6);
  }
}

TEST(FlipTest, GrowsWithTheError) {
  const Image reference = mapped(reference_image(), [](float v) { return 0.25F + 0.5F * v; });
  double before = 0;
  for (const float offset : {0.01F, 0.05F, 0.1F, 0.2F}) {
    const double now = flip(mapped(reference, [=](float v) { return v + offset; }), reference).mean;
    EXPECT_GT(now, before);
    before = now;
  }
}

TEST(FlipTest, FarAwayFineNoiseVanishes) {
  Image noise = constant(32, 32, 0.5F, 0.5F, 0.5F);
  for (int i = 0; i < 1024; ++i) {
    for (int c = 0; c < 3; ++c)
      noise.at(i % 32, i / 32, c) += (i % 32 + i / 32) % 2 == 0 ? 0.2F : -0.2F;
  }
  const Image gray = constant(32, 32, 0.5F, 0.5F, 0.5F);
  EXPECT_GT(flip(noise, gray, 10).mean, 4 * flip(noise, gray, 200).mean);
}

TEST(FlipTest, ADisplayShowsNothingBeyondItsRange) {
  EXPECT_EQ(flip(constant(4, 4, 1, 1, 1), constant(4, 4, 7, 2, 1e30F)).largest, 0);
  EXPECT_EQ(flip(constant(4, 4, 0, 0, 0), constant(4, 4, -1, -1e30F, 0)).largest, 0);
}

TEST(FlipTest, HdrSeesWhatADisplayClips) {
  Image reference = constant(24, 24, 0.2F, 0.2F, 0.2F);
  Image image = reference;
  for (int y = 8; y < 16; ++y) {
    for (int x = 8; x < 16; ++x) {
      for (int c = 0; c < 3; ++c) {
        reference.at(x, y, c) = 100;
        image.at(x, y, c) = 25;
      }
    }
  }
  EXPECT_EQ(flip(image, reference).largest, 0);
  EXPECT_GT(hdr_flip(image, reference).largest, 0.2);
}

TEST(FlipTest, HdrHasNoScale) {
  const HdrFlipResult plain = hdr_flip(bright(test_image()), bright(reference_image()));
  for (const int stops : {-40, 40}) {
    const auto scaled = [stops](const Image& image) {
      return mapped(bright(image), [stops](float v) { return std::ldexp(v, stops); });
    };
    const HdrFlipResult result = hdr_flip(scaled(test_image()), scaled(reference_image()));
    EXPECT_NEAR(result.start_exposure, plain.start_exposure - stops, 1e-9);
    for (std::size_t i = 0; i < plain.map.size(); ++i)
      EXPECT_NEAR(result.map[i], plain.map[i], 1e-6);
  }
}

TEST(FlipTest, HdrExposuresOfOneColourAndOfBlack) {
  // The curve (0.9036 x^2 + 0.018 x) / (0.8748 x^2 + 0.354 x + 0.14) is 0.85 at 2.118872.
  const HdrFlipResult one = hdr_flip(constant(2, 2, 1, 1, 1), constant(2, 2, 1, 1, 1));
  EXPECT_NEAR(one.start_exposure, std::log2(2.118872), 1e-6);
  EXPECT_EQ(one.start_exposure, one.stop_exposure);
  EXPECT_EQ(one.exposures, 2);
  const HdrFlipResult black = hdr_flip(constant(2, 2, 1, 1, 1), constant(2, 2, 0, 0, 0));
  EXPECT_EQ(black.start_exposure, 0);
  EXPECT_GT(black.mean, 0.5);
}

TEST(FlipTest, HdrMedianOverlooksABlackBackground) {
  Image reference = constant(3, 1, 0, 0, 0);
  for (int c = 0; c < 3; ++c) reference.at(1, 0, c) = 4;
  const HdrFlipResult result = hdr_flip(reference, reference);
  EXPECT_NEAR(result.stop_exposure, std::log2(2.118872 / 4), 1e-6);
}

TEST(FlipTest, PixelsThatAreNotFiniteAreLeftOut) {
  const Image reference = reference_image();
  Image image = reference;
  image.at(3, 2, 1) = std::numeric_limits<float>::quiet_NaN();
  image.at(7, 2, 0) = std::numeric_limits<float>::infinity();
  for (const FlipResult& result :
       {flip(image, reference), static_cast<FlipResult>(hdr_flip(image, reference))}) {
    EXPECT_TRUE(std::isnan(result.map[2 * 12 + 3]));
    EXPECT_TRUE(std::isnan(result.map[2 * 12 + 7]));
    EXPECT_EQ(
        std::count_if(result.map.begin(), result.map.end(), [](float v) { return std::isnan(v); }),
        2);
    EXPECT_EQ(result.mean, 0) << "the neighbours do not suffer";
  }
  const Image none = constant(2, 2, NAN, 0, 0);
  EXPECT_TRUE(std::isnan(flip(none, none).mean));
}

TEST(FlipTest, SmallImagesAndSmallDistances) {
  for (const double pixels_per_degree : {1.0, 67.0, 1000.0}) {
    const FlipResult pixel =
        flip(constant(1, 1, 0, 0, 0), constant(1, 1, 1, 1, 1), pixels_per_degree);
    EXPECT_NEAR(pixel.mean, 0.96738, 1e-5) << pixels_per_degree;
    expect_in_unit_range(flip(test_image(), reference_image(), pixels_per_degree));
  }
  for (const double bad : {0.0, -1.0, 1001.0, std::numeric_limits<double>::quiet_NaN()}) {
    const Image pixel = constant(1, 1, 0, 0, 0);
    EXPECT_NE(test::input_error_of([&] { return flip(pixel, pixel, bad); }).find("pixels a degree"),
              std::string::npos);
  }
}

}  // namespace

}  // namespace facet
