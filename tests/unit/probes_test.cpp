// Which pixels get a second estimate.
#include "convergence/probes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace facet::test {
namespace {

TEST(Probes, are_one_of_each_square_chosen_anew_by_each_seed) {
  for (const auto& [width, height, spacing] : {std::tuple(32, 16, 2), std::tuple(64, 64, 2),
                                               std::tuple(128, 128, 4), std::tuple(800, 600, 8)}) {
    std::vector<int> squares(static_cast<std::size_t>(width / spacing * (height / spacing)));
    const std::vector<std::uint32_t> probes = choose_probes(width, height, 3);
    EXPECT_TRUE(std::is_sorted(probes.begin(), probes.end()));
    for (const std::uint32_t p : probes) {
      const int x = static_cast<int>(p) % width / spacing;
      const int y = static_cast<int>(p) / width / spacing;
      ++squares[static_cast<std::size_t>(y * (width / spacing) + x)];
    }
    EXPECT_EQ(std::count(squares.begin(), squares.end(), 1),
              static_cast<std::ptrdiff_t>(squares.size()));
    EXPECT_NE(choose_probes(width, height, 4), probes);
  }
}

// Every pixel as likely, also those at borders that squares jut out over: of 2000 draws of 33 x 33
// pixels each is chosen 500 times, within 5 standard deviations.
TEST(Probes, every_pixel_is_chosen_as_likely) {
  std::vector<int> counts(33 * 33);
  for (std::uint32_t seed = 0; seed < 2000; ++seed) {
    for (const std::uint32_t p : choose_probes(33, 33, seed)) ++counts[p];
  }
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  EXPECT_GT(*least, 500 - 5 * 19.4);
  EXPECT_LT(*most, 500 + 5 * 19.4);
}

TEST(Probes, are_all_pixels_of_small_images) {
  const std::vector<std::uint32_t> probes = choose_probes(73, 7, 3);
  std::vector<std::uint32_t> all(73 * 7);
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_EQ(probes, all);
}

TEST(Probes, tiny_images_have_none) {
  EXPECT_FALSE(has_probes(1, 1));
  EXPECT_FALSE(has_probes(7, 9));
  EXPECT_TRUE(has_probes(8, 8));
}

}  // namespace
}  // namespace facet::test
