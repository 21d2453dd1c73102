// Estimated errors: what they should be, and whether it is noticed where they are not.
#include "convergence/error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "convergence/heavy_tails.h"

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
  EXPECT_NEAR(estimate_error(film).relmse / true_relmse(film), 1, 0.12);
  const HeavyTails tails = find_heavy_tails(film);
  EXPECT_EQ(tails.pixels, 0U);
  EXPECT_FALSE(tails.dominate());
}

TEST(ErrorEstimate, LightThatFewPixelsHaveFoundIsNoticed) {
  std::mt19937 random(1);
  std::bernoulli_distribution found(1.0 / 3200);
  const Film film = draw([&] { return found(random) ? 3200.0 : 0.0; });
  // One pixel in fifty has found it, and would have an error of 1 relative to itself.
  EXPECT_GT(true_relmse(film), 40);
  EXPECT_GT(estimate_error(film).relmse, true_relmse(film) / 2);
  EXPECT_LT(estimate_error(film).relmse, 3 * true_relmse(film));
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
  EXPECT_TRUE(find_heavy_tails(film).dominate());
}

/// Beside a bright and even lamp, pixels that it shines into seldom: their errors are relative to
/// what they have, not to the lamp, and not to what the luckiest of them have seen.
TEST(ErrorEstimate, IsRelativeToPixelsThatAreAlike) {
  double estimated = 0;
  double error = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::bernoulli_distribution flash(0.01);
    Film film = make_film(side, side, {0, 0, side, side}, true);
    double sum = 0;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        PixelSums& pixel = film.pixels[film.index(x, y)];
        const bool edge = y == 20;
        for (int k = 0; k < samples; ++k) {
          const double value = edge ? (flash(random) ? 40.0 : 0.0) : y < 20 ? 40.0 : 0.01;
          pixel.add({value, value, value});
        }
        const double truth = 0.4;
        const double epsilon = std::pow(0.01 * 40 * 20.3 / side, 2);
        if (edge) sum += std::pow(pixel.mean()[0] - truth, 2) / (truth * truth + epsilon);
      }
    }
    error += sum / static_cast<double>(film.pixels.size());
    estimated += estimate_error(film).relmse;
  }
  std::printf("estimated over true error: %.2f\n", estimated / error);
  EXPECT_GT(estimated, 0.7 * error);
  EXPECT_LT(estimated, 2 * error);
}

/// Samples that come in pairs, one as far above the truth as the other below, but for the last two,
/// of which one is the truth.
double add_in_order(PixelSums& sums, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double last = uniform(random);
  for (int k = 0; k < samples; ++k) {
    double value = k % 2 == 0 ? 1.5 : 0.5;
    if (k + 2 == samples) value = 1;
    if (k + 1 == samples) value = 1 + last;
    sums.add({value, value, value});
  }
  return sums.mean()[0] - 1;
}

TEST(ErrorEstimate, ProbesTellWhatOrderGains) {
  std::mt19937 random(1);
  Film film = make_film(side, side, {0, 0, side, side}, true);
  double error = 0;
  for (PixelSums& pixel : film.pixels) error += std::pow(add_in_order(pixel, random), 2);
  error /= side * side * 1.0001;
  const ErrorEstimate by_samples = estimate_error(film);
  EXPECT_GT(by_samples.relmse, 20 * error);
  EXPECT_EQ(by_samples.probes, 0U);
  EXPECT_EQ(by_samples.replicates, 64U);
  for (std::size_t p = 0; p < film.pixels.size(); p += 4) {
    film.probes.push_back({p, {}});
    add_in_order(film.probes.back().sums, random);
  }
  const ErrorEstimate by_probes = estimate_error(film);
  EXPECT_EQ(by_probes.probes, 1024U);
  EXPECT_EQ(by_probes.replicates, 2U);
  // Within five standard deviations of a chi-squared of 1024 degrees of freedom.
  EXPECT_NEAR(by_probes.relmse / error, 1, 5 * std::sqrt(2.0 / 1024));
  EXPECT_GT(by_probes.relative_upper(0.95), std::sqrt(error));
  EXPECT_LT(by_probes.relative_upper(0.95), 1.15 * std::sqrt(error));
  double squares = 0;
  for (const auto& e : standard_errors(film)) squares += e[1] * e[1];
  EXPECT_NEAR(squares / (side * side) / error, 1, 0.25);
}

TEST(ErrorEstimate, ProbesOfFewerSamplesTellTheSame) {
  std::mt19937 random(1);
  std::exponential_distribution<double> exponential(1);
  Film film = draw([&] { return exponential(random); });
  for (std::size_t p = 0; p < film.pixels.size(); p += 4) {
    film.probes.push_back({p, {}});
    for (int k = 0; k < samples / 4; ++k) {
      const double value = exponential(random);
      film.probes.back().sums.add({value, value, value});
    }
  }
  EXPECT_NEAR(estimate_error(film).relmse / true_relmse(film), 1, 0.25);
}

// The square of a normal variable is below 3.84 of its variances in 95 % of all cases.
TEST(ErrorEstimate, ASinglePixelIsAsUncertainAsASquare) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(1, 0.1);
  Film film = make_film(1, 1, {0, 0, 1, 1}, true);
  for (int k = 0; k < 1000; ++k) {
    const double value = normal(random);
    film.pixels[0].add({value, value, value});
  }
  const ErrorEstimate estimate = estimate_error(film);
  EXPECT_NEAR(estimate.relmse, 1e-5, 1.5e-6);
  EXPECT_NEAR(std::pow(estimate.relative_upper(0.95), 2) / estimate.relmse, 3.84, 0.05);
}

TEST(ErrorEstimate, FilmsWithoutNoiseOrLightHaveNoError) {
  EXPECT_EQ(estimate_error(draw([] { return 3.0; })).relmse, 0);
  EXPECT_EQ(estimate_error(draw([] { return 0.0; })).relative_upper(0.95), 0);
  EXPECT_EQ(estimate_error(Film()).relmse, 0);
}

TEST(ErrorEstimate, HasChannelsOfItsOwn) {
  std::mt19937 random(1);
  std::exponential_distribution<double> exponential(1);
  const Film film = draw([&] { return exponential(random); });
  const Image image = with_errors(develop(film, false), standard_errors(film));
  const int channel = image.find_channel("error.G");
  ASSERT_GE(channel, 0);
  const PixelSums& pixel = film.at(9, 3);
  EXPECT_FLOAT_EQ(image.at(9, 3, channel), static_cast<float>(std::sqrt(variance_of_mean(
                                               pixel.values[1], pixel.squares[1], pixel.samples))));
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
