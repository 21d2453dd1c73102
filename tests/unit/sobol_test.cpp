// The numbers of the sobol sampler: nets within pairs, nothing between them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "shared/random_hash.h"
#include "statistics/hypothesis.h"

namespace facet {

namespace {

/// Of 32 bits, the first `bits`.
std::uint32_t cell(std::uint32_t word, int bits) { return bits == 0 ? 0 : word >> (32 - bits); }

/// Whether every box of 2^-a by 2^-(k - a) holds exactly one of the 2^k samples from `first` on.
bool is_net(std::uint32_t pixel, std::uint32_t block, std::uint32_t seed, int pair,
            std::uint32_t first, int k) {
  const std::uint32_t count = 1U << k;
  for (int a = 0; a <= k; ++a) {
    std::vector<bool> full(count, false);
    for (std::uint32_t i = 0; i < count; ++i) {
      const shared::uvec4 words = shared::sobol_block(pixel, first + i, block, seed);
      const std::size_t box =
          cell(words[2 * pair], a) << (k - a) | cell(words[2 * pair + 1], k - a);
      if (full[box]) return false;
      full[box] = true;
    }
  }
  return true;
}

TEST(Sobol, aligned_runs_of_samples_are_nets_in_each_pair) {
  for (const auto& [pixel, block, seed] : {std::array{0U, 0U, 0U},
                                           {1U, 0U, 0U},
                                           {479999U, 17U, 5U},
                                           {77U, 0x80000003U, 4000000000U}}) {
    for (int pair = 0; pair < 2; ++pair) {
      for (int k = 0; k <= 10; ++k) {
        for (const std::uint32_t run : {0U, 1U, 2U, 3U, 1048575U})
          EXPECT_TRUE(is_net(pixel, block, seed, pair, run << k, k))
              << pixel << ' ' << block << ' ' << k;
      }
    }
  }
}

// The points themselves are Sobol's: unscrambled, they are known (I. M. Sobol' 1967).
TEST(Sobol, second_dimension_is_sobols) {
  const std::array<double, 8> expected{0, 0.5, 0.75, 0.25, 0.625, 0.125, 0.375, 0.875};
  for (std::uint32_t i = 0; i < expected.size(); ++i) {
    const std::uint32_t word = shared::reversed_bits(shared::reversed_sobol_1(i));
    EXPECT_EQ(word / 4294967296.0, expected.at(i)) << i;
  }
}

TEST(Sobol, bits_are_reversed) {
  EXPECT_EQ(shared::reversed_bits(0x00000001U), 0x80000000U);
  EXPECT_EQ(shared::reversed_bits(0x12345678U), 0x1e6a2c48U);
}

// Owen's scrambling: among the results of inputs that agree in their low n bits, so do the low n
// bits; and the next bit is as often turned as not, whatever the seed.
TEST(Sobol, hash_is_nested_and_unbiased) {
  std::array<int, 32> turned{};
  constexpr int trials = 4000;
  for (int i = 0; i < trials; ++i) {
    const shared::uvec4 r = shared::pcg4d({static_cast<std::uint32_t>(i), 1, 2, 3});
    for (int bit = 0; bit < 32; ++bit) {
      const std::uint32_t other = r.x ^ (1U << bit);
      const std::uint32_t difference =
          shared::laine_karras(r.x, r.y) ^ shared::laine_karras(other, r.y);
      ASSERT_EQ(difference << (31 - bit), 0x80000000U) << bit;
      turned.at(static_cast<std::size_t>(bit)) +=
          static_cast<int>((shared::laine_karras(r.x, r.y) ^ r.x) >> bit & 1U);
    }
  }
  const double critical =
      statistics::two_sided_normal_quantile(statistics::sidak_significance(0.01, 32));
  for (const int count : turned)
    EXPECT_LT(std::abs(count - trials / 2) / std::sqrt(trials / 4.0), critical);
}

/// One component of the numbers of a sample, in [0, 1).
using Numbers = std::function<double(std::uint32_t trial, std::uint32_t sample)>;

Numbers component(std::uint32_t pixel_offset, std::uint32_t block, std::uint32_t seed, int which) {
  return [=](std::uint32_t trial, std::uint32_t sample) {
    return shared::sobol_block(2 * trial + pixel_offset, sample, block, seed)[which] / 4294967296.0;
  };
}

struct Correlation {
  double mean = 0;    ///< over the trials, in standard deviations of independent numbers
  double square = 0;  ///< mean square, 1 for independent numbers
};

/// Correlation of two numbers over the samples of a pixel.
Correlation correlation(const Numbers& a, const Numbers& b) {
  constexpr std::uint32_t trials = 1024;
  constexpr std::uint32_t samples = 64;
  Correlation result;
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    double sum = 0;
    for (std::uint32_t i = 0; i < samples; ++i) sum += (a(trial, i) - 0.5) * (b(trial, i) - 0.5);
    const double c = sum * 12 / std::sqrt(samples);
    result.mean += c / std::sqrt(trials);
    result.square += c * c / trials;
  }
  return result;
}

// Shuffled apart, pairs are as good as independent. (The shuffle keeps runs together, which leaves
// the square above 1: two halves of a run of two lie in different halves of every axis.)
TEST(Sobol, pairs_blocks_pixels_and_seeds_are_uncorrelated) {
  const Numbers first = component(0, 4, 9, 0);
  const std::vector<Numbers> others{
      component(0, 4, 9, 2),  component(0, 4, 9, 3),          component(0, 5, 9, 0),
      component(0, 5, 9, 1),  component(0, 5, 9, 2),          component(0, 5, 9, 3),
      component(1, 4, 9, 0),  component(1, 4, 9, 1),          component(0, 4, 10, 0),
      component(0, 4, 10, 1), component(0, 0x80000004U, 9, 0)};
  const double critical =
      statistics::two_sided_normal_quantile(statistics::sidak_significance(0.01, others.size()));
  for (std::size_t i = 0; i < others.size(); ++i) {
    const Correlation c = correlation(first, others[i]);
    EXPECT_LT(std::abs(c.mean), critical * std::sqrt(c.square)) << i;
    EXPECT_GT(c.square, 0.5) << i;
    EXPECT_LT(c.square, 2) << i;
  }
}

}  // namespace

}  // namespace facet
