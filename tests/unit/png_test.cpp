// PNG files: how they are encoded, and that they are read as they are.
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>

#include "image/files.h"
#include "support/images.h"
#include "support/input.h"

namespace facet {

namespace {

using test::expect_message;
using test::input_error_of;
using test::make_image;

std::vector<std::uint8_t> codes_of_png(const std::filesystem::path& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&png, path.c_str()), 0) << png.message;
  png.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
  EXPECT_NE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr), 0) << png.message;
  return pixels;
}

class PngTest : public ::testing::Test {
 protected:
  test::TemporaryFolder folder_;
};

TEST_F(PngTest, PngIsEncodedAsSrgb) {
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<std::pair<float, int>> cases{
      {0.F, 0},   {1.F, 255}, {0.5F, 188},        {0.18F, 118}, {0.003F, 10}, {0.0002F, 1},
      {2.F, 255}, {-1.F, 0},  {std::nanf(""), 0}, {inf, 255},   {-inf, 0}};
  Image image(static_cast<int>(cases.size()), 1, {"R", "G", "B"});
  for (std::size_t i = 0; i < cases.size(); ++i)
    image.at(static_cast<int>(i), 0, 1) = cases[i].first;
  write_png(folder_.file("a.png"), image, 0);
  const auto pixels = codes_of_png(folder_.file("a.png"));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(pixels.at(3 * i + 1), cases[i].second) << cases[i].first;
    EXPECT_EQ(pixels.at(3 * i), 0) << "red, from another plane";
  }
}

TEST_F(PngTest, ExposureCountsStops) {
  Image image(2, 1, {"B", "G", "R"});
  image.at(0, 0, 2) = 0.25F;
  image.at(1, 0, 2) = 1;
  write_png(folder_.file("a.png"), image, 1);
  EXPECT_EQ(codes_of_png(folder_.file("a.png")), (std::vector<std::uint8_t>{188, 0, 0, 255, 0, 0}))
      << "channels go by name";
  write_png(folder_.file("a.png"), image, -1);
  EXPECT_EQ(codes_of_png(folder_.file("a.png"))[3], 188);
}

TEST_F(PngTest, PngIsReadAsLinear) {
  Image image(256, 1, {"R", "G", "B"});
  // 188 stands for ((188 / 255 + 0.055) / 1.055)^2.4 = 0.502886, 10 for 10 / 255 / 12.92.
  for (int x = 0; x < 256; ++x) image.at(x, 0, 1) = static_cast<float>(x) / 255;
  image.at(0, 0, 0) = 0.5F;
  image.at(0, 0, 2) = 0.003F;
  write_png(folder_.file("a.png"), image, 0);
  const Image back = read_image(folder_.file("a.png"));
  EXPECT_NEAR(back.at(0, 0, 0), 0.502886, 1e-6);
  EXPECT_NEAR(back.at(0, 0, 2), 10 / 255.0 / 12.92, 1e-8);
  EXPECT_EQ(back.at(0, 0, 1), 0);
  EXPECT_EQ(back.at(255, 0, 1), 1);
  EXPECT_EQ(back.window.full_width, 256);
  write_png(folder_.file("b.png"), back, 0);
  EXPECT_EQ(codes_of_png(folder_.file("a.png")), codes_of_png(folder_.file("b.png")))
      << "codes survive";
}

TEST_F(PngTest, OtherPngFormats) {
  const auto write = [&](png_uint_32 format, const void* pixels) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = png.height = 1;
    png.format = format;
    ASSERT_NE(png_image_write_to_file(&png, folder_.file("a.png").c_str(), 0, pixels, 0, nullptr),
              0);
  };
  const std::uint8_t gray = 255;
  write(PNG_FORMAT_GRAY, &gray);
  EXPECT_EQ(read_image(folder_.file("a.png")).at(0, 0, 2), 1);
  const std::uint8_t half[4] = {255, 0, 255, 0};
  write(PNG_FORMAT_RGBA, half);
  EXPECT_EQ(read_image(folder_.file("a.png")).at(0, 0, 0), 1)
      << "colours are read as they are, whatever their alpha";
}

/// A PNG of one grey sample, written with libpng's own functions.
void write_gray_png(const std::filesystem::path& path, int bits, std::uint16_t value, int alpha,
                    double gamma) {
  std::FILE* out = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, out);
  png_set_IHDR(png, info, 1, 1, bits, alpha >= 0 ? PNG_COLOR_TYPE_GRAY_ALPHA : PNG_COLOR_TYPE_GRAY,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (gamma > 0) png_set_gAMA(png, info, gamma);
  png_write_info(png, info);
  std::vector<png_byte> row;
  for (const int sample : {static_cast<int>(value), alpha}) {
    if (sample < 0) continue;
    if (bits == 16) row.push_back(static_cast<png_byte>(sample >> 8));
    row.push_back(static_cast<png_byte>(sample & 255));
  }
  png_write_row(png, row.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  (void)std::fclose(out);
}

/// Nori takes bytes over 255, whatever else the file says of them: 128 was read as 186 under a
/// gamma of 1, and as 93 with half an alpha.
TEST_F(PngTest, PngBytesAreReadAsTheyAre) {
  const auto path = folder_.file("a.png");
  for (const auto& [alpha, gamma] : {std::pair(-1, 0.0), std::pair(-1, 1.0), std::pair(-1, 0.45455),
                                     std::pair(128, 0.0), std::pair(0, 1.0)}) {
    write_gray_png(path, 8, 128, alpha, gamma);
    EXPECT_EQ(read_png(path).codes, (std::vector<std::uint16_t>(3, 128))) << alpha << " " << gamma;
    EXPECT_EQ(read_png(path).largest, 255);
  }
  write_gray_png(path, 16, 0x1234, -1, 1.0);
  EXPECT_EQ(read_png(path).codes, (std::vector<std::uint16_t>(3, 0x1234)));
  EXPECT_EQ(read_png(path).largest, 65535);
  write_gray_png(path, 16, 0xfffe, 0x1234, 0);
  EXPECT_EQ(read_png(path).codes, (std::vector<std::uint16_t>(3, 0xfffe)));
  // (0x8000 / 65535 + 0.055) / 1.055 to the power of 2.4
  write_gray_png(path, 16, 0x8000, -1, 0);
  EXPECT_NEAR(read_image(path).at(0, 0, 1), 0.2140482, 1e-6);
}

TEST_F(PngTest, UnreadablePngFilesAreNamed) {
  write_png(folder_.file("a.png"), make_image(20, 20, {"R", "G", "B"}), 0);
  const std::string whole = folder_.read("a.png");
  for (const std::string& text :
       {std::string(), std::string("text"), whole.substr(0, whole.size() / 2)}) {
    folder_.write("bad.png", text);
    expect_message(input_error_of([&] { return read_png(folder_.file("bad.png")); }),
                   folder_.file("bad.png").string(), {"not a readable PNG"});
  }
  std::string huge = whole;
  huge.replace(16, 8, std::string("\x00\x0f\x42\x40\x00\x0f\x42\x40", 8));
  folder_.write("bad.png", huge);
  (void)input_error_of([&] { return read_png(folder_.file("bad.png")); });
  expect_message(input_error_of([&] { return read_image(folder_.file("none.png")); }),
                 folder_.file("none.png").string(), {"no such file"});
  expect_message(input_error_of([&] { return read_image(folder_.file("a.jpg")); }),
                 folder_.file("a.jpg").string(), {"no such file"});
  expect_message(input_error_of([&] { return read_image(folder_.write("page.png", "<html>")); }),
                 folder_.file("page.png").string(), {"web page"});
}

}  // namespace

}  // namespace facet
