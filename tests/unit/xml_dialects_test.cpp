// XML as other programs write it: encodings, blanks; and what is not XML though pugixml reads it.
#include <gtest/gtest.h>

#include <string_view>

#include "scene/reader.h"
#include "support/input.h"

namespace facet {

namespace {

using test::expect_message;
using test::input_error_of;
using test::place;

class XmlDialectsTest : public ::testing::Test {
 protected:
  Scene read(const std::string& text) {
    diagnostics_ = Diagnostics();
    return read_scene(folder_.write("scene.xml", text), diagnostics_);
  }
  void expect_error(const std::string& text, int line, std::initializer_list<const char*> words) {
    SCOPED_TRACE(text);
    expect_message(input_error_of([&] { return read(text); }),
                   place(folder_.file("scene.xml"), line), words);
  }

  test::TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

/// ASCII in units of `size` bytes, behind a mark.
std::string widened(std::string_view text, std::size_t size, bool big_endian, bool with_mark) {
  std::string wide;
  const auto add = [&](unsigned unit) {
    for (std::size_t i = 0; i < size; ++i)
      wide += static_cast<char>(unit >> 8U * static_cast<unsigned>(big_endian ? size - 1 - i : i) &
                                255U);
  };
  if (with_mark) add(0xFEFF);
  for (const char c : text) add(static_cast<unsigned char>(c));
  return wide;
}

TEST_F(XmlDialectsTest, WideEncodingsKeepTheirLines) {
  const std::string good =
      "<scene>\n\n<camera type=\"perspective\">\n<integer name=\"width\" "
      "value=\"7\"/></camera></scene>";
  const std::string bad =
      "<scene>\n\n<camera type=\"perspective\">\n<integer name=\"width\" "
      "value=\"x\"/></camera></scene>";
  for (const std::size_t size : {2U, 4U}) {
    for (const bool big_endian : {false, true}) {
      for (const bool with_mark : {false, true}) {
        SCOPED_TRACE(size);
        EXPECT_EQ(read(widened(good, size, big_endian, with_mark)).camera.width, 7);
        expect_error(widened(bad, size, big_endian, with_mark), 4, {"\"width\"", "\"x\""});
        expect_error(widened("<scene>\n<camera", size, big_endian, with_mark), 2,
                     {"not well-formed"});
      }
    }
  }
}

TEST_F(XmlDialectsTest, LettersOfEveryEncodingAreThoseOfTheFileName) {
  const std::string name = "\xC3\xA9\xF0\x9F\x90\x87.obj";  // é and a rabbit
  folder_.write(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder_.write("\xC3\xA9.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto scene_with = [](const std::string& file) {
    return "<scene><camera type=\"perspective\"/><mesh type=\"obj\"><string name=\"filename\" "
           "value=\"" +
           file + "\"/><bsdf type=\"diffuse\"/></mesh></scene>";
  };
  EXPECT_EQ(read(scene_with(name)).meshes.size(), 1U);
  EXPECT_EQ(read("\xEF\xBB\xBF" + scene_with(name)).meshes.size(), 1U);
  std::string wide = widened(scene_with("@"), 2, false, true);
  const std::size_t at = wide.find('@');
  wide.replace(at, 2, std::string("\xE9\x00\x3D\xD8\x07\xDC.\0o\0b\0j\0", 14));
  EXPECT_EQ(read(wide).meshes.size(), 1U);
  const std::string latin1 = "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>";
  EXPECT_EQ(read(latin1 + scene_with("\xE9.obj")).meshes.size(), 1U);
}

TEST_F(XmlDialectsTest, BlanksAroundAWordDoNotMatter) {
  const Scene scene = read(
      "<scene><camera type=\"perspective\"><integer name=\"width\" value=\" 8 \"/><integer "
      "name=\"height\" "
      "value=\"\t9\n\"/><float name=\"fov\" value=\" 40 \"/></camera></scene>");
  EXPECT_EQ(scene.camera.width, 8);
  EXPECT_EQ(scene.camera.height, 9);
  EXPECT_EQ(scene.camera.fov, 40);
  expect_error(
      "<scene><camera type=\"perspective\">\n<integer name=\"width\" value=\"8 "
      "9\"/></camera></scene>",
      2, {"\"8 9\"", "not an integer"});
  expect_error(
      "<scene><camera type=\"perspective\">\n<integer name=\"width\" value=\" "
      "\"/></camera></scene>",
      2, {"not an integer"});
}

TEST_F(XmlDialectsTest, AnAttributeStandsOnce) {
  expect_error("<scene>\n<camera type=\"perspective\" type=\"orthographic\"/></scene>", 2,
               {"not well-formed", "<camera>", "\"type\"", "twice"});
  expect_error("<scene a=\"1\" a=\"1\"><camera type=\"perspective\"/></scene>", 1,
               {"<scene>", "twice"});
}

TEST_F(XmlDialectsTest, EntitiesOfOnesOwnAreRefused) {
  const std::string start =
      "<!DOCTYPE scene [<!ENTITY w \"8\">]>\n<scene><camera type=\"perspective\">\n";
  expect_error(start + "<integer name=\"width\" value=\"&w;\"/></camera></scene>", 3,
               {"&w;", "not supported"});
  EXPECT_EQ(read(start + "<integer name=\"width\" value=\"&#56;\"/></camera></scene>").camera.width,
            8);
  // A file may have such a name.
  expect_error(
      "<scene><camera type=\"perspective\"/>\n<mesh type=\"obj\"><string name=\"filename\" "
      "value=\"a&amp;b;.obj\"/></mesh></scene>",
      2, {"a&b;.obj", "no such file"});
}

TEST_F(XmlDialectsTest, NothingStandsWithinAStepOfATransform) {
  const std::string start = "<scene><camera type=\"perspective\"><transform name=\"toWorld\">\n";
  const std::string end = "</transform></camera></scene>";
  for (const char* step :
       {"translate value=\"1 2 3\"", "scale value=\"2\"", "rotate axis=\"0 1 0\" angle=\"3\"",
        "lookat origin=\"0 0 0\" target=\"0 0 1\" up=\"0 1 0\""}) {
    const std::string name = std::string(step).substr(0, std::string(step).find(' '));
    expect_error(start + "<" + step + ">\n<scale value=\"2\"/></" + name + ">" + end, 3,
                 {"<scale> inside", name.c_str()});
  }
}

TEST_F(XmlDialectsTest, DeepTagsAreNoEndOfTheStack) {
  std::string deep = "<scene>";
  for (int i = 0; i < 100'000; ++i) deep += "<mesh>";
  for (int i = 0; i < 100'000; ++i) deep += "</mesh>";
  (void)input_error_of([&] { return read(deep + "</scene>"); });
}

TEST_F(XmlDialectsTest, MessagesAreShortAndWithoutControlCharacters) {
  const std::string message = input_error_of([&] {
    return read("<scene><camera type=\"\x1B[31m" + std::string(100'000, 'x') + "\"/></scene>");
  });
  EXPECT_LT(message.size(), 3000U);
  EXPECT_EQ(message.find('\x1B'), std::string::npos);
  EXPECT_NE(message.find("\\x1b[31m"), std::string::npos);
}

}  // namespace

}  // namespace facet
