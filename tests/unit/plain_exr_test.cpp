// The fast reader of facet's own EXRs: the same bits as were written, and no other files.
#include "image/plain_exr.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "image/files.h"
#include "support/images.h"
#include "support/input.h"

namespace facet::test {

namespace {

class PlainExrTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file() const { return folder_.file("a.exr").string(); }

  /// Floats of every kind, integers, and a window within a larger image.
  static Image make(int height) {
    Image image = make_image(37, height, {"B", "G", "R", "state.image.00", "sum.R"});
    image.window = {5, 7, 100, 90};
    image.at(0, 0, 0) = std::numeric_limits<float>::infinity();
    image.at(1, 0, 0) = std::numeric_limits<float>::quiet_NaN();
    image.at(2, 0, 0) = -0.0F;
    image.at(3, 0, 0) = std::numeric_limits<float>::denorm_min();
    image.at(0, height - 1, 3) = std::bit_cast<float>(0x7f800001U);
    return image;
  }

  static std::uint32_t bits(const Image& image, int x, int y, int c) {
    return std::bit_cast<std::uint32_t>(image.at(x, y, c));
  }

  TemporaryFolder folder_;
};

TEST_F(PlainExrTest, ReadsTheBitsThatWereWritten) {
  for (const auto compression : {ExrCompression::zip, ExrCompression::uncompressed}) {
    // Chunks of ZIP have sixteen rows.
    for (const int height : {1, 15, 16, 17, 40}) {
      const Image written = make(height);
      write_exr(file(), written, compression);
      Image image(37, height, written.channels());
      ASSERT_TRUE(read_plain_exr(file(), image));
      for (int c = 0; c < 5; ++c) {
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < 37; ++x)
            ASSERT_EQ(bits(image, x, y, c), bits(written, x, y, c)) << x << ' ' << y << ' ' << c;
        }
      }
    }
  }
}

TEST_F(PlainExrTest, LeavesOtherFilesToOthers) {
  const Image written = make(20);
  write_exr(file(), written);
  Image narrower(36, 20, written.channels());
  EXPECT_FALSE(read_plain_exr(file(), narrower));
  Image lower(37, 19, written.channels());
  EXPECT_FALSE(read_plain_exr(file(), lower));
  Image fewer(37, 20, {"B", "G", "R", "sum.R"});
  EXPECT_FALSE(read_plain_exr(file(), fewer));
  Image others(37, 20, {"B", "G", "R", "state.image.01", "sum.R"});
  EXPECT_FALSE(read_plain_exr(file(), others));
  Image image(37, 20, written.channels());
  EXPECT_FALSE(read_plain_exr(folder_.file("none.exr"), image));
}

TEST_F(PlainExrTest, DamageIsNoImage) {
  for (const auto compression : {ExrCompression::zip, ExrCompression::uncompressed}) {
    const Image written = make(40);
    write_exr(file(), written, compression);
    const std::string bytes = folder_.read("a.exr");
    for (const std::size_t left :
         {std::size_t{0}, std::size_t{3}, std::size_t{200}, bytes.size() / 2, bytes.size() - 1}) {
      folder_.write("a.exr", bytes.substr(0, left));
      Image image(37, 40, written.channels());
      EXPECT_FALSE(read_plain_exr(file(), image)) << left;
      EXPECT_ANY_THROW((void)read_exr(file())) << left;
    }
  }
}

}  // namespace

}  // namespace facet::test
