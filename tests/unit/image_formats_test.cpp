// Images of every format that is read, each written by its own library or by hand.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <gtest/gtest.h>

#include <boost/crc.hpp>
#include <cmath>
#include <cstdio>

// libjpeg's header expects what the standard's declare.
#include <jpeglib.h>

#include "image/color_image.h"
#include "image/files.h"
#include "support/input.h"

namespace facet {

namespace {

using test::expect_message;
using test::input_error_of;

class ImageFormatsTest : public ::testing::Test {
 protected:
  void expect_refusal(const std::string& name, std::initializer_list<const char*> words) {
    expect_message(input_error_of([&] { return read_image(folder_.file(name)); }),
                   folder_.file(name).string(), words);
  }
  test::TemporaryFolder folder_;
};

/// Of one colour, at the best quality.
void write_jpeg(const std::filesystem::path& path, int width, int height,
                std::vector<std::uint8_t> color) {
  std::FILE* out = std::fopen(path.c_str(), "wb");
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  jpeg_stdio_dest(&jpeg, out);
  jpeg.image_width = static_cast<JDIMENSION>(width);
  jpeg.image_height = static_cast<JDIMENSION>(height);
  jpeg.input_components = static_cast<int>(color.size());
  jpeg.in_color_space = color.size() == 3 ? JCS_RGB : JCS_GRAYSCALE;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<JSAMPLE> row;
  for (int x = 0; x < width; ++x) row.insert(row.end(), color.begin(), color.end());
  JSAMPROW rows[1] = {row.data()};
  for (int y = 0; y < height; ++y) (void)jpeg_write_scanlines(&jpeg, rows, 1);
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  (void)std::fclose(out);
}

TEST_F(ImageFormatsTest, JpegIsReadAsCodes) {
  write_jpeg(folder_.file("a.jpg"), 17, 9, {200, 100, 50});
  const CodedImage image = read_jpeg(folder_.file("a.jpg"));
  EXPECT_EQ(image.width, 17);
  EXPECT_EQ(image.height, 9);
  EXPECT_EQ(image.largest, 255);
  ASSERT_EQ(image.codes.size(), 17U * 9 * 3);
  for (std::size_t i = 0; i < image.codes.size(); ++i)
    EXPECT_NEAR(image.codes[i], i % 3 == 0 ? 200 : i % 3 == 1 ? 100 : 50, 2);
  write_jpeg(folder_.file("gray.jpeg"), 2, 2, {188});
  EXPECT_NEAR(read_image(folder_.file("gray.jpeg")).at(1, 1, 2), 0.5029F, 0.01F)
      << "decoded from sRGB";
  // Its bytes tell the format.
  std::filesystem::copy(folder_.file("a.jpg"), folder_.file("a.PNG"));
  EXPECT_EQ(read_image(folder_.file("a.PNG")).width(), 17);
}

TEST_F(ImageFormatsTest, DamagedJpegIsRefused) {
  write_jpeg(folder_.file("a.jpg"), 64, 64, {200, 100, 50});
  const std::string whole = folder_.read("a.jpg");
  for (const std::size_t size : {std::size_t{3}, whole.size() / 2, whole.size() - 10}) {
    folder_.write("cut.jpg", whole.substr(0, size));
    expect_refusal("cut.jpg", {"not a readable JPEG"});
  }
}

const std::string hdr_header = "#?RADIANCE\n# by hand\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1\n\n";

TEST_F(ImageFormatsTest, HdrIsMantissaTimesPowerOfTwo) {
  // 128 2^(129 - 136) = 1; an exponent of 137 doubles.
  folder_.write("a.hdr", hdr_header + "-Y 2 +X 2\n" +
                             std::string("\x80\x40\x20\x81"
                                         "\x80\x40\x20\x82"
                                         "\xFF\x01\x00\x80"
                                         "\x00\x00\x00\x00",
                                         16));
  const Image image = read_image(folder_.file("a.hdr"));
  EXPECT_EQ(image.at(0, 0, 0), 1);
  EXPECT_EQ(image.at(0, 0, 1), 0.5F);
  EXPECT_EQ(image.at(0, 0, 2), 0.25F);
  EXPECT_EQ(image.at(1, 0, 0), 2);
  EXPECT_EQ(image.at(0, 1, 0), 255.F / 256);
  EXPECT_EQ(image.at(0, 1, 1), 1.F / 256);
  EXPECT_EQ(image.at(1, 1, 0), 0);
}

TEST_F(ImageFormatsTest, HdrRunsAreExpanded) {
  // Eight pixels: red 5 copies and a run, green one run, blue copies, exponents a run.
  std::string row("\x02\x02\x00\x08", 4);
  row += std::string("\x05\x01\x02\x03\x04\x05\x83\x09", 8);
  row += "\x88\x80";
  row += std::string("\x08\x07\x06\x05\x04\x03\x02\x01\x00", 9);
  row += "\x88\x88";
  folder_.write("a.hdr", hdr_header + "-Y 1 +X 8\n" + row);
  const Image image = read_image(folder_.file("a.hdr"));
  for (int x = 0; x < 8; ++x) {
    EXPECT_EQ(image.at(x, 0, 0), x < 5 ? static_cast<float>(x + 1) : 9.F) << x;
    EXPECT_EQ(image.at(x, 0, 1), 128);
    EXPECT_EQ(image.at(x, 0, 2), static_cast<float>(7 - x));
  }
  // The old kind: a pixel, then repeated 2 + 256 times.
  folder_.write("old.hdr", hdr_header + "-Y 1 +X 260\n" +
                               std::string("\x80\x00\x00\x81"
                                           "\x01\x01\x01\x02"
                                           "\x01\x01\x01\x01"
                                           "\x40\x00\x00\x81",
                                           16));
  const Image old = read_image(folder_.file("old.hdr"));
  for (int x = 0; x < 260; ++x) EXPECT_EQ(old.at(x, 0, 0), x < 259 ? 1.F : 0.5F) << x;
  // Every way to end too early, and a run beyond the row.
  for (std::size_t size = 0; size < row.size(); ++size) {
    folder_.write("cut.hdr", hdr_header + "-Y 1 +X 8\n" + row.substr(0, size));
    expect_refusal("cut.hdr", {"not a readable HDR", "too early"});
  }
  folder_.write("bad.hdr", hdr_header + "-Y 1 +X 8\n" + std::string("\x02\x02\x00\x08\xFF\x01", 6));
  expect_refusal("bad.hdr", {"a run leaves its row"});
  folder_.write("zero.hdr",
                hdr_header + "-Y 1 +X 8\n" + std::string("\x02\x02\x00\x08\x00\x00\x00\x00", 8));
  expect_refusal("zero.hdr", {"a run leaves its row"});
}

TEST_F(ImageFormatsTest, OtherHdrIsRefused) {
  folder_.write("xyz.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234");
  expect_refusal("xyz.hdr", {"xyze"});
  folder_.write("turned.hdr", hdr_header + "+X 1 -Y 1\n1234");
  expect_refusal("turned.hdr", {"+X 1 -Y 1"});
  folder_.write("headless.hdr", "#?RADIANCE\nFORMAT=");
  expect_refusal("headless.hdr", {"header"});
  folder_.write("huge.hdr", hdr_header + "-Y 1000000 +X 1000000\n");
  expect_refusal("huge.hdr", {"1000000x1000000"});
}

TEST_F(ImageFormatsTest, PartsOfAnExrAreLayers) {
  std::vector<Imf::Header> headers;
  for (const auto& [name, channels] : {std::pair("depth", std::vector<std::string>{"Z"}),
                                       std::pair("beauty", std::vector<std::string>{"B", "G", "R"}),
                                       std::pair("small", std::vector<std::string>{"Y"})}) {
    Imf::Header header(2, 1);
    if (std::string(name) == "small") header.dataWindow().max.x = 0;
    header.setName(name);
    header.setType(Imf::SCANLINEIMAGE);
    for (const std::string& c : channels) header.channels().insert(c, Imf::Channel(Imf::FLOAT));
    headers.push_back(header);
  }
  float values[2] = {3, 4};
  {
    Imf::MultiPartOutputFile out(folder_.file("parts.exr").c_str(), headers.data(), 3);
    for (int part = 0; part < 3; ++part) {
      Imf::FrameBuffer buffer;
      for (auto c = headers[static_cast<std::size_t>(part)].channels().begin();
           c != headers[static_cast<std::size_t>(part)].channels().end(); ++c)
        buffer.insert(c.name(),
                      Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values), sizeof(float), 0));
      Imf::OutputPart pixels(out, part);
      pixels.setFrameBuffer(buffer);
      pixels.writePixels(1);
      values[0] += 2;
    }
  }
  const Image image = read_exr(folder_.file("parts.exr"));
  EXPECT_EQ(image.channels(), (std::vector<std::string>{"Z", "beauty.B", "beauty.G", "beauty.R"}));
  EXPECT_EQ(image.at(0, 0, 0), 3);
  const ColorImage colors = color_image(image, "parts.exr");
  EXPECT_EQ(colors.pixels, (std::vector<Color>{Color(5), Color(4)}));
}

TEST_F(ImageFormatsTest, SizesBeyondTheLimitAreRefusedBeforeTheyAreAllocated) {
  const auto refusal = [](long long width, long long height, std::size_t channels) {
    return input_error_of([&] { check_file_image_size("a.exr", width, height, channels); });
  };
  check_file_image_size("a.exr", 1 << 14, 1 << 14, 8);
  expect_message(refusal(1 << 14, 1 << 14, 9), "a.exr", {"16384x16384", "9 channels"});
  expect_message(refusal(1 << 15, 1 << 14, 1), "a.exr", {"32768x16384"});
  expect_message(refusal((1 << 20) + 1, 1, 1), "a.exr", {"1048577x1"});
  expect_message(refusal(0, 1, 1), "a.exr", {"0x1"});
  write_exr(folder_.file("a.exr"), Image(2, 2, {"R"}));
  std::string damaged = folder_.read("a.exr");
  const std::size_t window =
      damaged.find("dataWindow") + std::string_view("dataWindow?box2i?????").size();
  damaged.replace(window + 8, 4, std::string("\xFF\xFF\xFF\x00", 4));
  folder_.write("huge.exr", damaged);
  expect_refusal("huge.exr", {"16777216x2"});
}

TEST_F(ImageFormatsTest, SizesBeyondTheFilesBytesAreRefusedBeforeTheyAreAllocated) {
  // A picture of one colour is as small as pictures get.
  write_exr(folder_.file("grey.exr"), Image(1024, 1024, {"R", "G", "B"}));
  EXPECT_EQ(read_image(folder_.file("grey.exr")).width(), 1024);
  write_png(folder_.file("grey.png"), Image(1024, 1024, {"R", "G", "B"}), 0);
  EXPECT_EQ(read_image(folder_.file("grey.png")).width(), 1024);

  write_exr(folder_.file("a.exr"), Image(2, 2, {"R", "G", "B"}));
  std::string damaged = folder_.read("a.exr");
  const std::size_t window =
      damaged.find("dataWindow") + std::string_view("dataWindow?box2i?????").size();
  damaged.replace(window + 8, 8, std::string("\xFF\xFF\x07\0\1\0\0\0", 8));
  folder_.write("large.exr", damaged);
  expect_refusal("large.exr", {"524288x2 pixels", "bytes cannot hold"});

  std::string png = folder_.read("grey.png");
  const std::size_t header = png.find("IHDR");
  png.replace(header + 4, 8, std::string("\0\0\x3F\xFF\0\0\x3F\xFF", 8));
  boost::crc_32_type crc;
  crc.process_bytes(png.data() + header, 17);
  for (unsigned i = 0; i < 4; ++i)
    png[header + 17 + i] = static_cast<char>(crc.checksum() >> (24 - 8 * i));
  folder_.write("large.png", png.substr(0, 5000));
  expect_refusal("large.png", {"16383x16383 pixels", "bytes cannot hold"});
}

// OpenEXR allocates what an attribute announces before it reads any of it.
TEST_F(ImageFormatsTest, AttributesBeyondTheFilesBytesAreRefused) {
  Image image(2, 2, {"R"});
  image.metadata = {{"owner", "me"}};
  write_exr(folder_.file("a.exr"), image);
  std::string damaged = folder_.read("a.exr");
  const std::size_t size = damaged.find("owner") + std::string_view("owner?string?").size();
  damaged.replace(size, 4, std::string("\0\0\0\x7F", 4));
  folder_.write("huge.exr", damaged);
  expect_refusal("huge.exr", {"an attribute of its header announces 2130706432 bytes"});
}

TEST_F(ImageFormatsTest, FilesOfOtherKindsAreNamed) {
  folder_.write("lfs.png", "version https://git-lfs.github.com/spec/v1\n");
  expect_refusal("lfs.png", {"Git LFS pointer"});
  folder_.write("empty.exr", "");
  expect_refusal("empty.exr", {"empty"});
  folder_.write("a.tif", std::string("II*\0", 4));
  expect_refusal("a.tif", {"TIFF", "convert"});
}

}  // namespace

}  // namespace facet
