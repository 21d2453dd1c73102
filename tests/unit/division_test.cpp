// Renders divided into shares: every sample and every row in one of them, as equal as they can be.
#include "image/division.h"

#include <gtest/gtest.h>

#include <array>

namespace facet::test {

namespace {

TEST(Division, SharesCoverAllOnceAndAreEqual) {
  for (const std::uint32_t begin : {0U, 7U}) {
    for (const std::uint32_t length : {1U, 2U, 16U, 17U, 1000U, 1U << 30U}) {
      for (const std::uint32_t count : {1U, 2U, 3U, 7U, 16U, 1000U}) {
        if (count > length) continue;
        std::uint32_t reached = begin;
        for (std::uint32_t i = 1; i <= count; ++i) {
          const SampleRange part = share_of(SampleRange{begin, begin + length}, Share{i, count});
          ASSERT_EQ(part.begin, reached);
          const std::uint32_t held = part.end - part.begin;
          ASSERT_TRUE(held == length / count || held == length / count + 1);
          reached = part.end;
        }
        EXPECT_EQ(reached, begin + length);
      }
    }
  }
}

TEST(Division, TilesAreRows) {
  const Crop whole{3, 10, 40, 21};
  EXPECT_EQ(share_of(whole, Share{1, 3}), (Crop{3, 10, 40, 13}));
  EXPECT_EQ(share_of(whole, Share{2, 3}), (Crop{3, 13, 40, 17}));
  EXPECT_EQ(share_of(whole, Share{3, 3}), (Crop{3, 17, 40, 21}));
}

TEST(Division, SharesAreFoundBySamplesAndPixels) {
  const Division division{{0, 100}, 7, {0, 0, 30, 20}, 3};
  for (std::uint32_t p = 1; p <= 7; ++p) {
    for (std::uint32_t t = 1; t <= 3; ++t) {
      const auto share = find_share(division, share_of(division.samples, Share{p, 7}),
                                    share_of(division.pixels, Share{t, 3}));
      ASSERT_TRUE(share);
      EXPECT_EQ(share->part.index, p);
      EXPECT_EQ(share->tile.index, t);
    }
  }
  EXPECT_FALSE(find_share(division, {0, 15}, {0, 0, 30, 6}));
  EXPECT_FALSE(find_share(division, {0, 14}, {0, 0, 30, 7}));
}

TEST(Division, TextsAreReadAsTheyAreWritten) {
  const Division division{{0, 1U << 30U}, 1000, {1, 2, 100000, 900}, 7};
  EXPECT_EQ(division_text(division), "1000 parts of 0:1073741824, 7 tiles of 1,2,100000,900");
  EXPECT_EQ(parse_division(division_text(division)), division);
  for (const char* text :
       {"", "4 parts of 0:16", "4 parts of 0:16, 3 tiles of 0,0,9",
        "0 parts of 0:16, 1 tiles of 0,0,9,9", "17 parts of 0:16, 1 tiles of 0,0,9,9",
        "4 parts of 16:16, 1 tiles of 0,0,9,9", "4 parts of 0:16, 10 tiles of 0,0,9,9",
        "4 parts of 0:16, 1 tiles of 0,0,9,9 ", "-4 parts of 0:16, 1 tiles of 0,0,9,9",
        "4 parts of 0:16, 1 tiles of -1,0,9,9", "4 parts of 0:4294967312, 1 tiles of 0,0,9,9",
        "4  parts of 0:16, 1 tiles of 0,0,9,9", "04 parts of 0:16, 1 tiles of 0,0,9,9",
        "4 parts of 0:16, 1 tiles of 9,0,9,9", "4294967300 parts of 0:16, 1 tiles of 0,0,9,9",
        "1048577 parts of 0:1048577, 1 tiles of 0,0,9,9"})
    EXPECT_FALSE(parse_division(text)) << text;
}

TEST(Division, SharesAreReadWithinTheirCount) {
  const auto share = parse_share("3/16");
  ASSERT_TRUE(share);
  EXPECT_EQ(share->index, 3U);
  EXPECT_EQ(share->count, 16U);
  for (const char* text :
       {"", "/", "3", "3/", "/16", "0/16", "17/16", "-1/16", "3/16/2", "a/16", "3/1099511627776"})
    EXPECT_FALSE(parse_share(text)) << text;
}

TEST(Division, NamesOfFilesSortInOrder) {
  EXPECT_EQ(share_file("cbox", Share{3, 16}, std::nullopt), "cbox_part_03_of_16.exr");
  EXPECT_EQ(share_file("cbox", std::nullopt, Share{2, 4}), "cbox_tile_2_of_4.exr");
  EXPECT_EQ(share_file("cbox", Share{16, 100}, Share{2, 4}),
            "cbox_tile_2_of_4_part_016_of_100.exr");
}

}  // namespace

}  // namespace facet::test
