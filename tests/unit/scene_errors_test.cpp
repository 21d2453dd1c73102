// What the scene reader says about mistakes: file, line, and words that help.
#include <gtest/gtest.h>

#include "image/files.h"
#include "scene/reader.h"
#include "support/input.h"

namespace facet {

namespace {

using test::expect_message;
using test::input_error_of;
using test::place;
using Words = std::initializer_list<const char*>;

const std::string camera = "<camera type=\"perspective\"/>\n";
const std::string triangle_file = "<string name=\"filename\" value=\"triangle.obj\"/>";

class SceneErrorsTest : public ::testing::Test {
 protected:
  void SetUp() override { folder_.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"); }

  Scene read(const std::string& text, Diagnostics& diagnostics) const {
    return read_scene(folder_.write("scene.xml", text), diagnostics);
  }
  void expect_error(const std::string& text, int line, Words words) const {
    Diagnostics diagnostics;
    const std::string message = input_error_of([&] { return read(text, diagnostics); });
    expect_message(message, place(folder_.file("scene.xml"), line), words);
  }
  /// The body begins on line 3.
  void expect_body_error(const std::string& body, int line, Words words) const {
    expect_error("<scene>\n" + camera + body + "\n</scene>", line, words);
  }
  /// The properties begin on line 3.
  void expect_camera_error(const std::string& properties, Words words) const {
    expect_error("<scene><camera type=\"perspective\">\n\n" + properties + "</camera></scene>", 3,
                 words);
  }
  /// The content begins on line 4.
  void expect_mesh_error(const std::string& content, int line, Words words) const {
    expect_body_error("<mesh type=\"obj\">" + triangle_file + "\n" + content + "\n</mesh>", line,
                      words);
  }
  /// Exactly one warning, and an error under --strict.
  void expect_warning(const std::string& text, int line, Words words) const {
    Diagnostics diagnostics;
    (void)read(text, diagnostics);
    ASSERT_EQ(diagnostics.warnings().size(), 1U);
    expect_message(diagnostics.warnings()[0], place(folder_.file("scene.xml"), line), words);
    Diagnostics strict(true);
    const std::string message = input_error_of([&] { return read(text, strict); });
    expect_message(message, place(folder_.file("scene.xml"), line), words);
    EXPECT_NE(message.find("--strict"), std::string::npos);
  }

  test::TemporaryFolder folder_;
};

TEST_F(SceneErrorsTest, UnknownPropertiesAreWarnings) {
  expect_warning(
      "<scene>\n<camera type=\"perspective\">\n<float name=\"fvo\" "
      "value=\"1\"/>\n</camera></scene>",
      3, {"camera \"perspective\"", "\"fvo\"", "ignored", "did you mean \"fov\"?"});
  expect_warning(
      "<scene>\n" + camera +
          "<emitter type=\"environment\">\n<float name=\"rotate\" value=\"9\"/></emitter></scene>",
      4, {"environment", "\"rotate\"", "ignored"});
  expect_warning("<scene>\n" + camera + "<boolean name=\"b\" value=\"true\"/></scene>", 3,
                 {"scene", "\"b\"", "ignored"});
  expect_warning("<scene>\n" + camera + "<point name=\"p\" value=\"1 2 3\"/></scene>", 3,
                 {"\"p\"", "ignored"});
  expect_warning("<scene>\n" + camera + "<vector name=\"v\" value=\"1 2 3\"/></scene>", 3,
                 {"\"v\"", "ignored"});
}

TEST_F(SceneErrorsTest, AMeshWithoutFacesIsAWarning) {
  folder_.write("empty.obj", "v 0 0 0\n");
  expect_warning(
      "<scene>\n" + camera +
          "<mesh type=\"obj\"><string name=\"filename\" value=\"empty.obj\"/></mesh></scene>",
      3, {"empty.obj", "no faces"});
}

TEST_F(SceneErrorsTest, TextureOfNoKnownNameIsNotSilent) {
  Diagnostics strict(true);
  const std::string text =
      "<scene>\n" + camera + "<mesh type=\"obj\">" + triangle_file +
      "<bsdf type=\"diffuse\">\n<texture type=\"checker\" name=\"albdo\"/></bsdf></mesh></scene>";
  const std::string message = input_error_of([&] { return read(text, strict); });
  expect_message(message, place(folder_.file("scene.xml"), 4), {"albdo"});
}

TEST_F(SceneErrorsTest, TagsAndTypes) {
  expect_body_error("<emiter type=\"area\"/>", 3,
                    {"unknown tag <emiter>", "did you mean \"emitter\"?"});
  expect_body_error("<integrator type=\"path_miss\"/>", 3,
                    {"unknown type", "did you mean \"path_mis\"?"});
  expect_body_error("<sampler type=\"quasi\"/>", 3, {"sampler", "quasi", "unknown type"});
  expect_body_error("\n\n<mesh/>", 5, {"<mesh>", "lacks", "\"type\""});
  expect_mesh_error("<bsdf type=\"difuse\"/>", 4,
                    {"bsdf \"difuse\"", "unknown type", "did you mean \"diffuse\"?"});
  expect_mesh_error("<emitter type=\"aera\"/>", 4, {"unknown type", "did you mean \"area\"?"});
  expect_camera_error("<rfilter type=\"bx\"/>", {"rfilter", "did you mean \"box\"?"});
  expect_error("<scene>\n<camera type=\"perspectiv\"/></scene>", 2,
               {"did you mean \"perspective\"?"});
}

TEST_F(SceneErrorsTest, MediaAndTests) {
  expect_body_error("<medium type=\"homogeneous\"/>", 3, {"<medium>", "not supported"});
  expect_mesh_error("<phase type=\"hg\"/>", 4, {"<phase>", "not supported"});
  expect_error("\n<test type=\"ttest\"/>", 2, {"<test>", "facet test"});
}

TEST_F(SceneErrorsTest, CamerasAndOtherSingles) {
  expect_error("<scene>\n</scene>", 1, {"no camera"});
  expect_body_error(camera, 3, {"more than one <camera>"});
  expect_body_error("<sampler type=\"independent\"/>\n<sampler type=\"independent\"/>", 4,
                    {"more than one <sampler>"});
  expect_body_error("<integrator type=\"ao\"/>\n<integrator type=\"ao\"/>", 4,
                    {"more than one <integrator>"});
  expect_body_error("<emitter type=\"environment\"/>\n<emitter type=\"environment\"/>", 4,
                    {"more than one environment"});
  expect_mesh_error("<bsdf type=\"diffuse\"/><bsdf type=\"diffuse\"/>", 4,
                    {"more than one <bsdf>"});
  expect_mesh_error("<emitter type=\"area\"/>\n<emitter type=\"area\"/>", 5,
                    {"more than one <emitter>"});
}

TEST_F(SceneErrorsTest, ChildrenInTheWrongPlace) {
  expect_body_error("<bsdf type=\"diffuse\"/>", 3, {"scene", "cannot hold a <bsdf>"});
  expect_body_error("<emitter type=\"area\"/>", 3, {"belongs to a mesh"});
  expect_mesh_error("<emitter type=\"environment\"/>", 4, {"belongs to the scene"});
  expect_mesh_error("<mesh type=\"obj\"/>", 4, {"cannot hold a <mesh>"});
  expect_body_error("<scene/>", 3, {"cannot hold a <scene>"});
}

TEST_F(SceneErrorsTest, CameraValues) {
  expect_camera_error("<integer name=\"width\" value=\"0\"/>", {"\"width\"", "is 0"});
  expect_camera_error("<integer name=\"height\" value=\"-5\"/>", {"\"height\"", "is -5"});
  expect_camera_error(
      "<integer name=\"width\" value=\"100000\"/><integer name=\"height\" value=\"100000\"/>",
      {"100000x100000", "pixels"});
  expect_camera_error("<float name=\"width\" value=\"16\"/>",
                      {"\"width\"", "<integer>", "<float>"});
  expect_camera_error("<float name=\"fov\" value=\"180\"/>", {"\"fov\"", "less than 180"});
  expect_camera_error("<float name=\"fov\" value=\"1.0f\"/>", {"1.0f", "not a number"});
  expect_camera_error("<float name=\"farClip\" value=\"1e-5\"/>", {"\"farClip\"", "greater than"});
  for (const char* values : {"<float name=\"B\" value=\"4\"/><float name=\"C\" value=\"0\"/>",
                             "<float name=\"B\" value=\"10\"/>",
                             "<float name=\"C\" value=\"-1\"/><float name=\"B\" value=\"0\"/>"})
    expect_camera_error("<rfilter type=\"mitchell\">" + std::string(values) + "</rfilter>",
                        {"\"C\"", "with B = "});
  expect_camera_error("<float name=\"nearClip\" value=\"-1\"/>", {"\"nearClip\"", "negative"});
  expect_camera_error("<transform name=\"toWorld\"><scale value=\"0\"/></transform>",
                      {"\"toWorld\"", "invertible"});
}

TEST_F(SceneErrorsTest, DuplicateProperties) {
  const char* twice = "<float name=\"fov\" value=\"1\"/><integer name=\"fov\" value=\"2\"/>";
  expect_camera_error(twice, {"camera \"perspective\"", "\"fov\"", "twice"});
}

TEST_F(SceneErrorsTest, Files) {
  expect_body_error("<mesh type=\"obj\"/>", 3, {"mesh \"obj\"", "filename"});
  expect_body_error("<mesh type=\"obj\">\n<string name=\"filename\" value=\"none.obj\"/></mesh>", 3,
                    {"none.obj", "cannot read"});
  expect_body_error("<mesh type=\"obj\"><string name=\"filename\" value=\".\"/></mesh>", 3,
                    {"cannot read"});
  const auto environment = [](const std::string& file) {
    return "<emitter type=\"environment\"><string name=\"filename\" value=\"" + file +
           "\"/></emitter>";
  };
  expect_body_error(environment("none.exr"), 3, {"none.exr", "no such file"});
  expect_body_error(environment("triangle.obj"), 3,
                    {"triangle.obj", "not an OpenEXR, PNG, JPEG or HDR image", "v 0 0 0"});
  write_exr(folder_.file("mask.exr"), Image(1, 1, {"A", "Depth.Z"}));
  expect_body_error(environment("mask.exr"), 3,
                    {"mask.exr", "no channels R, G and B", "A, Depth.Z"});
}

TEST_F(SceneErrorsTest, TheSceneFileItself) {
  Diagnostics diagnostics;
  const auto expect_unreadable = [&](const std::filesystem::path& path, const char* word) {
    const std::string message = input_error_of([&] { return read_scene(path, diagnostics); });
    expect_message(message, path.string(), {word});
  };
  expect_unreadable(folder_.file("none.xml"), "no such file");
  expect_unreadable(folder_.path(), "a folder");
  expect_error("version https://git-lfs.github.com/spec/v1\n", 2,
               {"not well-formed", "git lfs pull"});
  expect_error("", 1, {"not well-formed XML"});
  expect_error("v 0 0 0", 1, {"not well-formed XML"});
  expect_error("\n<mesh type=\"obj\"/>", 2, {"<mesh>", "<scene> expected"});
}

TEST_F(SceneErrorsTest, XmlThatIsNotWellFormed) {
  expect_error("<scene>\n<camera type=\"perspective\">\n</scene>", 3, {"not well-formed XML"});
  expect_error("<scene>\n<camera type=\"perspective/>\n</scene>", 2, {"not well-formed XML"});
  expect_error("<scene>\n<camera type=perspective/>\n</scene>", 2, {"not well-formed XML"});
  expect_error("<scene>\n\n<camera type=\"persp", 3, {"not well-formed XML"});
  expect_error("<scene>\n<camera type=\"perspective\"/>\n<!-- no end", 3, {"not well-formed XML"});
}

TEST_F(SceneErrorsTest, ASecondRootIsNotSilent) {
  expect_error("<scene>\n" + camera + "</scene>\n<scene>\n</scene>", 4, {"<scene>"});
}

TEST_F(SceneErrorsTest, StrayTextHasItsOwnLine) {
  expect_body_error("stray", 3, {"stray text", "scene", "stray"});
  expect_camera_error("words", {"stray text", "camera \"perspective\"", "words"});
  expect_body_error("<![CDATA[stray]]>", 3, {"stray"});
}

TEST_F(SceneErrorsTest, PropertiesHoldNothing) {
  expect_camera_error(
      "<float name=\"fov\" value=\"40\"><float name=\"nearClip\" value=\"1\"/></float>",
      {"<float>"});
  expect_camera_error("<float name=\"fov\" value=\"40\">50</float>", {"50"});
}

TEST_F(SceneErrorsTest, FiltersThatCannotWork) {
  const std::string begin =
      "<scene><camera type=\"perspective\">\n\n<rfilter type=\"gaussian\"><float name=";
  const std::string end = "/></rfilter></camera></scene>";
  expect_error(begin + "\"radius\" value=\"0\"" + end, 3, {"\"radius\"", "but must be"});
  expect_error(begin + "\"stddev\" value=\"-1\"" + end, 3, {"\"stddev\"", "but must be"});
}

TEST_F(SceneErrorsTest, RadianceBeyondFloats) {
  expect_mesh_error("<emitter type=\"area\"><float name=\"scale\" value=\"1e39\"/></emitter>", 4,
                    {"emitter \"area\""});
  expect_mesh_error("<emitter type=\"area\"><float name=\"scale\" value=\"-1\"/></emitter>", 4,
                    {"\"scale\"", "negative"});
  expect_mesh_error("<emitter type=\"area\"><color name=\"radiance\" value=\"-1\"/></emitter>", 4,
                    {"\"radiance\"", "negative"});
}

}  // namespace

}  // namespace facet
