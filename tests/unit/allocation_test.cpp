// How adaptive sampling gives samples to pixels.
#include "convergence/allocation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <random>

#include "image/film.h"

namespace facet::test {
namespace {

/// The films of a pilot whose pixels are lognormal, with a deviation of their own each.
struct PilotFilms {
  Film first_half;
  Film all;
};

template <typename Deviation>
PilotFilms make_pilot(int width, int height, std::uint32_t mean, const Deviation& deviation) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  PilotFilms films{make_film(width, height, {0, 0, width, height}, true), {}};
  films.all = films.first_half;
  const std::uint32_t samples = pilot_samples(mean);
  for (std::uint32_t k = 0; k < samples; ++k) {
    if (k == samples / 2) films.first_half = films.all;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double v = std::exp(deviation(x, y) * normal(random));
        films.all
            .pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x)]
            .add({v, v, v});
      }
    }
  }
  return films;
}

/// For a mean of so many samples, the pilot's among them.
std::vector<std::uint32_t> allocate(const Film& first_half, const Film& all, std::uint32_t mean) {
  return Allocation(first_half, all).counts(mean, mean - pilot_samples(mean));
}

std::uint64_t sum_of(const std::vector<std::uint32_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

TEST(Allocation, gives_powers_of_two_within_its_bounds_and_budget) {
  for (const std::uint32_t mean : {16U, 17U, 64U, 100U, 1000U, 100000U}) {
    const PilotFilms films =
        make_pilot(40, 30, mean, [](int x, int y) { return x < 20 ? 0.01 : (y == 7 ? 2.0 : 0.3); });
    const auto counts = allocate(films.first_half, films.all, mean);
    ASSERT_EQ(counts.size(), 1200U);
    for (const std::uint32_t n : counts) {
      EXPECT_TRUE(std::has_single_bit(n));
      EXPECT_GE(n, smallest_allocation(mean));
      EXPECT_LE(n, 64 * mean);
    }
    const double budget = 1200.0 * (mean - pilot_samples(mean));
    EXPECT_LE(static_cast<double>(sum_of(counts)), budget) << mean;
    EXPECT_GE(static_cast<double>(sum_of(counts)), 0.9 * budget) << mean;
  }
}

TEST(Allocation, pixels_of_more_variance_get_more) {
  const PilotFilms films =
      make_pilot(64, 64, 256, [](int x, int /*y*/) { return x < 32 ? 0.02 : 0.6; });
  const auto counts = allocate(films.first_half, films.all, 256);
  double quiet = 0;
  double noisy = 0;
  for (int y = 4; y < 60; ++y) {
    for (int x = 4; x < 60; ++x) {
      if (x >= 28 && x < 36) continue;
      (x < 32 ? quiet : noisy) +=
          counts[static_cast<std::size_t>(y) * 64 + static_cast<std::size_t>(x)];
    }
  }
  EXPECT_GT(noisy, 8 * quiet);
}

// Where all pixels are alike, what differs in the pilot is chance, and decides little.
TEST(Allocation, chance_decides_little) {
  const PilotFilms films = make_pilot(64, 64, 256, [](int, int) { return 0.5; });
  const auto counts = allocate(films.first_half, films.all, 256);
  const auto [least, most] = std::ranges::minmax(counts);
  EXPECT_GE(least, 64U);
  EXPECT_LE(most, 512U);
}

TEST(Allocation, a_black_image_has_equal_pixels) {
  Film black = make_film(8, 8, {0, 0, 8, 8}, true);
  for (PixelSums& p : black.pixels) p.samples = 4;
  Film half = black;
  for (PixelSums& p : half.pixels) p.samples = 2;
  const auto counts = allocate(half, black, 32);
  const auto [least, most] = std::ranges::minmax(counts);
  EXPECT_EQ(least, most);
}

}  // namespace
}  // namespace facet::test
