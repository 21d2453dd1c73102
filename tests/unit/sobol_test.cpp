// The numbers of the sobol sampler: nets within pairs, nothing between them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <vector>

#include "shared/random_hash.h"
#include "statistics/hypothesis.h"

namespace facet {

namespace {

/// Of 32 bits, the first `bits`.
std::uint32_t cell(std::uint32_t word, int bits) { return bits == 0 ? 0 : word >> (32 - bits); }

/// Whether every box of 2^-a by 2^-(k - a) holds exactly one of 2^k points, a pair of components.
bool is_net(const std::vector<shared::uvec4>& points, int pair) {
  const int k = static_cast<int>(std::bit_width(points.size())) - 1;
  for (int a = 0; a <= k; ++a) {
    std::vector<bool> full(points.size(), false);
    for (const shared::uvec4& words : points) {
      const std::size_t box =
          cell(words[2 * pair], a) << (k - a) | cell(words[2 * pair + 1], k - a);
      if (full[box]) return false;
      full[box] = true;
    }
  }
  return true;
}

/// The same of the 2^k samples of a pixel from `first` on.
bool is_net(std::uint32_t pixel, std::uint32_t block, std::uint32_t seed, int pair,
            std::uint32_t first, int k) {
  std::vector<shared::uvec4> points;
  for (std::uint32_t i = 0; i < 1U << k; ++i)
    points.push_back(shared::sobol_block(pixel, first + i, block, seed));
  return is_net(points, pair);
}

/// 2^k samples from `first` on of each pixel of a square, of those zsobol orders 2^bits of.
std::vector<shared::uvec4> points_of_square(shared::uvec2 corner, std::uint32_t side,
                                            std::uint32_t first, int k, std::uint32_t bits,
                                            std::uint32_t block) {
  std::vector<shared::uvec4> points;
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      for (std::uint32_t i = 0; i < 1U << k; ++i)
        points.push_back(
            shared::zsobol_block(corner + shared::uvec2(x, y), first + i, bits, block, 5));
    }
  }
  return points;
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

TEST(Zsobol, aligned_runs_of_samples_are_nets_in_each_pair) {
  for (const shared::uvec2 pixel : {shared::uvec2(0, 0), {5, 2}, {799, 598}, {1048575, 3}}) {
    for (const std::uint32_t bits : {0U, 3U, 4U, 10U, 30U}) {
      for (int k = 0; k <= std::min(static_cast<int>(bits), 8); ++k) {
        for (const std::uint32_t run : {0U, 1U, 5U}) {
          const auto points = points_of_square(pixel, 1, run << k, k, bits, 7);
          EXPECT_TRUE(is_net(points, 0) && is_net(points, 1)) << bits << ' ' << k;
        }
      }
    }
  }
}

TEST(Zsobol, samples_of_aligned_squares_are_nets) {
  for (const std::uint32_t bits : {0U, 1U, 4U, 5U}) {
    for (int j = 0; j <= 3; ++j) {
      const std::uint32_t side = 1U << j;
      for (const shared::uvec2 corner : {shared::uvec2(0, 0), {24, 8}, {1000, 40}}) {
        for (const std::uint32_t run : {0U, 3U}) {
          const auto points =
              points_of_square(corner, side, run << bits, static_cast<int>(bits), bits, 2);
          EXPECT_TRUE(is_net(points, 0) && is_net(points, 1)) << bits << ' ' << side;
        }
      }
    }
  }
}

/// How often, of many blocks, the first points of two pixels lie in different halves.
double share_in_different_halves(shared::uvec2 a, shared::uvec2 b) {
  constexpr std::uint32_t blocks = 4000;
  int different = 0;
  for (std::uint32_t block = 0; block < blocks; ++block)
    different += static_cast<int>(cell(shared::zsobol_block(a, 0, 0, block, 5).x, 1) !=
                                  cell(shared::zsobol_block(b, 0, 0, block, 5).x, 1));
  return static_cast<double>(different) / blocks;
}

// The two points of a half of a square are in different halves of the unit interval, those of
// pixels in different halves as often as not. Half of the time a half is a column of the square, a
// quarter of the time a row, a quarter two pixels across. On a plain Morton curve it would always
// be a row, and errors form stripes.
TEST(Zsobol, every_pair_of_a_square_is_a_half_of_it_now_and_then) {
  const double allowed = statistics::two_sided_normal_quantile(0.01 / 6) * 0.5 / std::sqrt(4000.0);
  for (const std::uint32_t side : {0U, 6U}) {
    const shared::uvec2 corner(side, side);
    EXPECT_NEAR(share_in_different_halves(corner, corner + shared::uvec2(1, 0)), 0.625, allowed);
    EXPECT_NEAR(share_in_different_halves(corner, corner + shared::uvec2(0, 1)), 0.75, allowed);
    EXPECT_NEAR(share_in_different_halves(corner, corner + shared::uvec2(1, 1)), 0.625, allowed);
  }
}

// Tiles are as large as 32 bits can count: of 2^4 samples, 2^14 pixels square.
TEST(Zsobol, tiles_and_further_samples_have_nets_of_their_own) {
  int same_cells = 0;
  constexpr std::uint32_t blocks = 1000;
  for (std::uint32_t block = 0; block < blocks; ++block) {
    const std::uint32_t first = shared::zsobol_block({3, 4}, 0, 4, block, 5).x;
    for (const std::uint32_t other :
         {shared::zsobol_block({3, 4}, 16, 4, block, 5).x,
          shared::zsobol_block({3 + (1U << 14U), 4}, 0, 4, block, 5).x,
          shared::zsobol_block({3, 4 + (1U << 14U)}, 0, 4, block, 5).x}) {
      EXPECT_NE(first, other);
      same_cells += static_cast<int>(cell(first, 4) == cell(other, 4));
    }
  }
  // One of sixteen, as of independent numbers; within a net, the same cell would be rarer.
  const double expected = 3 * blocks / 16.0;
  EXPECT_LT(std::abs(same_cells - expected),
            statistics::two_sided_normal_quantile(0.01) * std::sqrt(expected * 15 / 16));
}

TEST(Zsobol, curve_fills_every_square_before_it_goes_on) {
  for (const std::uint32_t turns : {0U, 1U, 2U, 3U, 0x5555aaaaU, 0x9d2c5680U}) {
    std::vector<bool> seen(1U << 12U, false);
    for (std::uint32_t y = 0; y < 64; ++y) {
      for (std::uint32_t x = 0; x < 64; ++x) {
        const std::uint32_t place = shared::place_on_curve({x, y}, turns);
        ASSERT_LT(place, seen.size());
        EXPECT_FALSE(seen[place]);
        seen[place] = true;
        // The square of 2^j pixels that a pixel is in is told by all but the last 2j bits.
        for (std::uint32_t j = 1; j < 6; ++j) {
          const std::uint32_t corner = shared::place_on_curve({x >> j << j, y >> j << j}, turns);
          EXPECT_EQ(place >> 2 * j, corner >> 2 * j);
        }
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
