// Estimated errors: what they should be, and whether it is noticed where they are not.
#include "image/error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace facet {

namespace {

constexpr int side = 64;
constexpr int samples = 64;

/// A grey film whose samples are all drawn alike.
Film draw(const std::function<double()>& sample, int samples_per_pixel = samples) {
  Film film = make_film(side, side, {5, 7, 100, 100}, true);
  for (PixelSums& pixel : film.pixels) {
    for (int i = 0; i < samples_per_pixel; ++i) {
      const double value = sample();
      pixel.add({value, value, value});
    }
  }
  return film;
}

/// Of a film whose samples have mean 1: what the estimate is about.
double true_relmse(const Film& film) {
  double sum = 0;
  for (const PixelSums& pixel : film.pixels)
    sum += std::pow(pixel.values[0] / pixel.samples - 1, 2);
  return sum / static_cast<double>(film.pixels.size()) / 1.0001;
}

TEST(ErrorEstimate, IsTheErrorWhereTailsAreLight) {
  std::mt19937 random(1);
  std::exponential_distribution<double> exponential(1);
  const Film film = draw([&] { return exponential(random); });
  EXPECT_NEAR(estimate_relmse(film) / true_relmse(film), 1, 0.1);
  const HeavyTails tails = find_heavy_tails(film);
  EXPECT_EQ(tails.pixels, 0U);
  EXPECT_FALSE(tails.dominate());
}

TEST(ErrorEstimate, LightThatFewPixelsHaveFoundIsNoticed) {
  std::mt19937 random(1);
  std::bernoulli_distribution found(1.0 / 3200);
  const Film film = draw([&] { return found(random) ? 3200.0 : 0.0; });
  // One pixel in fifty has found it, and looks as if it had an error of 1; those that have not, of
  // 0.
  EXPECT_LT(estimate_relmse(film), 0.03);
  EXPECT_GT(true_relmse(film), 40);
  const HeavyTails tails = find_heavy_tails(film);
  EXPECT_NEAR(static_cast<double>(tails.pixels), side * side * (1 - std::exp(-0.02)), 30);
  EXPECT_EQ(tails.variance_share, 1);
  EXPECT_TRUE(tails.dominate());
}

/// P(x > t) = t^-1.2: the mean exists and the variance does not.
TEST(ErrorEstimate, InfiniteVarianceIsNoticed) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  const Film film = draw([&] { return std::pow(1 - uniform(random), -1 / 1.2) / 6; }, 1000);
  EXPECT_LT(2 * estimate_relmse(film), true_relmse(film));
  EXPECT_TRUE(find_heavy_tails(film).dominate());
}

/// The edge of a lamp: pixels of which any share is bright beside dim and even ones.
TEST(ErrorEstimate, EdgesAreNoTails) {
  Film film = make_film(side, side, {0, 0, side, side}, true);
  for (int i = 0; i < side * side; ++i) {
    const int bright = i % side == 20 ? i / side : 0;
    for (int k = 0; k < samples; ++k) {
      const double value = k < bright ? 40 : 0.1;
      film.pixels[static_cast<std::size_t>(i)].add({value, value, value});
    }
  }
  const HeavyTails tails = find_heavy_tails(film);
  EXPECT_EQ(tails.pixels, 3U);
  EXPECT_LT(tails.variance_share, 0.02);
}

/// k bright samples among n count as k, within the bias of the variance's estimate: k (n - 1) / (n
/// - k).
TEST(ErrorEstimate, PixelsCountThatRestOnFewerThanFourSamples) {
  for (int bright = 1; bright <= 8; ++bright) {
    Film film = make_film(side, 1, {5, 7, 100, 100}, true);
    for (int k = 0; k < samples; ++k) film.pixels[9].add({k < bright ? 1.0 : 0.0, 0, 0});
    const HeavyTails tails = find_heavy_tails(film);
    ASSERT_EQ(tails.pixels, bright < 4 ? 1U : 0U) << bright;
    if (bright >= 4) continue;
    EXPECT_EQ(tails.worst, (std::vector<std::array<int, 2>>{{14, 7}}));
  }
}

TEST(ErrorEstimate, TheWorstPixelsComeFirst) {
  Film film = make_film(side, 1, {0, 0, side, 1}, true);
  for (int x = 0; x < side; ++x) {
    film.pixels[static_cast<std::size_t>(x)].add({0, x % 32 * 1.0, 0});
    for (int k = 1; k < samples; ++k) film.pixels[static_cast<std::size_t>(x)].add({0, 0, 0});
  }
  const HeavyTails tails = find_heavy_tails(film);
  EXPECT_EQ(tails.pixels, 62U);
  ASSERT_EQ(tails.worst.size(), 10U);
  EXPECT_EQ(tails.worst[0], (std::array<int, 2>{31, 0}));
  EXPECT_EQ(tails.worst[1], (std::array<int, 2>{63, 0}));
  EXPECT_EQ(tails.worst[9], (std::array<int, 2>{59, 0}));
}

TEST(ErrorEstimate, FewSamplesAndFilmsWithoutSquaresSayNothing) {
  Film film = make_film(side, 1, {0, 0, side, 1}, true);
  for (std::uint32_t k = 0; k + 1 < HeavyTails::least_samples; ++k)
    film.pixels[9].add({k == 0 ? 1.0 : 0.0, 0, 0});
  EXPECT_EQ(find_heavy_tails(film).pixels, 0U);
  film.pixels[9].add({0, 0, 0});
  EXPECT_EQ(find_heavy_tails(film).pixels, 1U);
  film.has_squares = false;
  EXPECT_EQ(find_heavy_tails(film).pixels, 0U);
  EXPECT_FALSE(find_heavy_tails(film).dominate());
}

}  // namespace

}  // namespace facet
