// Headers of EXR files: every type of attribute that OpenEXR writes is read, and none that
// announces other bytes than it has.
#include <ImfChannelList.h>
#include <ImfCompressionAttribute.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfLineOrderAttribute.h>
#include <ImfOutputFile.h>
#include <ImfPreviewImage.h>
#include <ImfPreviewImageAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfTileDescriptionAttribute.h>
#include <gtest/gtest.h>

#include "image/files.h"
#include "support/input.h"

namespace facet::test {
namespace {

class ExrAttributesTest : public ::testing::Test {
 protected:
  /// A file of one pixel with the attributes of a header.
  std::string write(Imf::Header header) const {
    header.channels().insert("R", Imf::Channel(Imf::FLOAT));
    const std::filesystem::path path = folder_.file("a.exr");
    Imf::OutputFile file(path.c_str(), header);
    float pixel = 1;
    Imf::FrameBuffer buffer;
    buffer.insert("R", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&pixel), 4, 4));
    file.setFrameBuffer(buffer);
    file.writePixels(1);
    return path.string();
  }

  /// The file with other bytes after a text that occurs once.
  void expect_refused(const std::string& text, const std::string& bytes) const {
    std::string damaged = folder_.read("a.exr");
    const std::size_t at = damaged.find(text);
    ASSERT_NE(at, std::string::npos);
    damaged.replace(at + text.size(), bytes.size(), bytes);
    folder_.write("damaged.exr", damaged);
    expect_message(input_error_of([&] { (void)read_exr(folder_.file("damaged.exr")); }),
                   folder_.file("damaged.exr").string(),
                   {"not a readable EXR image: ", "announces"});
  }

  TemporaryFolder folder_;
};

Imf::Header header_of_all_types() {
  Imf::Header header(1, 1);
  header.insert("a1", Imf::Box2iAttribute());
  header.insert("a2", Imf::Box2fAttribute());
  header.insert("a3", Imf::ChromaticitiesAttribute());
  header.insert("a4", Imf::DeepImageStateAttribute());
  header.insert("a5", Imf::DoubleAttribute());
  header.insert("a6", Imf::EnvmapAttribute());
  header.insert("a7", Imf::FloatAttribute());
  header.insert("a8", Imf::FloatVectorAttribute(std::vector<float>{1, 2, 3}));
  header.insert("a9", Imf::IntAttribute());
  header.insert("b1", Imf::KeyCodeAttribute());
  header.insert("b2", Imf::M33fAttribute());
  header.insert("b3", Imf::M33dAttribute());
  header.insert("b4", Imf::M44fAttribute());
  header.insert("b5", Imf::M44dAttribute());
  header.insert("b6", Imf::PreviewImageAttribute(Imf::PreviewImage(3, 2)));
  header.insert("b7", Imf::RationalAttribute());
  header.insert("b8", Imf::StringAttribute("text"));
  header.insert("b9", Imf::StringVectorAttribute(std::vector<std::string>{"one", "", "three"}));
  header.insert("c1", Imf::TileDescriptionAttribute());
  header.insert("c2", Imf::TimeCodeAttribute());
  header.insert("c3", Imf::V2iAttribute());
  header.insert("c4", Imf::V2fAttribute());
  header.insert("c5", Imf::V2dAttribute());
  header.insert("c6", Imf::V3iAttribute());
  header.insert("c7", Imf::V3fAttribute());
  header.insert("c8", Imf::V3dAttribute());
  header.insert("c9", Imf::CompressionAttribute());
  header.insert("d1", Imf::LineOrderAttribute());
  header.insert("d2", Imf::StringVectorAttribute());
  header.insert("d3", Imf::StringAttribute(""));
  return header;
}

TEST_F(ExrAttributesTest, EveryTypeIsRead) {
  const std::string path = write(header_of_all_types());
  EXPECT_EQ(read_exr(path).at(0, 0, 0), 1);
  EXPECT_EQ(read_exr_header(path).width, 1);
}

/// A header that is read otherwise than it was written: what follows is taken for anything.
TEST_F(ExrAttributesTest, ValuesOfOtherSizesAreRefused) {
  (void)write(header_of_all_types());
  const std::string five("\5\0\0\0", 4);
  for (const std::string type : {"a1?box2i", "a3?chromaticities", "a5?double", "b1?keycode",
                                 "b2?m33f", "b5?m44d", "b6?preview", "b7?rational",
                                 "b9?stringvector", "c1?tiledesc", "c6?v3i", "c9?compression"}) {
    std::string text = type + '\0';
    std::replace(text.begin(), text.end(), '?', '\0');
    expect_refused(text, five);
  }
  // A string of a vector, a preview's width, and a name in the list of channels.
  const std::string vector("b9\0stringvector\0\x14\0\0\0", 20);
  expect_refused(vector, std::string("\0\0\0\x70", 4));
  const std::string preview("b6\0preview\0\x20\0\0\0", 15);
  expect_refused(preview, std::string("\0\0\0\x70", 4));
  const std::string channels("chlist\0\x13\0\0\0", 11);
  expect_refused(channels, "RRRR");
}

}  // namespace
}  // namespace facet::test
