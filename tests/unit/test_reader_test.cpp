// Test files: what they hold, and what is said about mistakes.
#include "scene/test_reader.h"

#include <gtest/gtest.h>

#include "scene/reader.h"
#include "support/input.h"

namespace facet {

namespace {

using test::expect_message;
using test::input_error_of;
using test::place;
using Words = std::initializer_list<const char*>;

const std::string scene =
    "<scene><integrator type=\"normals\"/><camera type=\"perspective\"><integer name=\"width\" "
    "value=\"7\"/></camera></scene>\n";
const std::string angles = "<string name=\"angles\" value=\"0, 45\"/>\n";

std::string references(const std::string& list) {
  return "<string name=\"references\" value=\"" + list + "\"/>\n";
}

class TestReaderTest : public ::testing::Test {
 protected:
  /// The content begins on line 2.
  StatisticalTest read(const std::string& type, const std::string& content,
                       Diagnostics& diagnostics) const {
    return read_test(
        folder_.write("test.xml", "<test type=\"" + type + "\">\n" + content + "</test>"),
        diagnostics);
  }
  StatisticalTest read(const std::string& type, const std::string& content) const {
    Diagnostics diagnostics;
    StatisticalTest test = read(type, content, diagnostics);
    EXPECT_TRUE(diagnostics.warnings().empty());
    return test;
  }
  void expect_error(const std::string& type, const std::string& content, int line,
                    Words words) const {
    const std::string message = input_error_of([&] { return read(type, content); });
    expect_message(message, place(folder_.file("test.xml"), line), words);
  }

  test::TemporaryFolder folder_;
};

TEST_F(TestReaderTest, DefaultsOfTheChiSquaredTest) {
  const StatisticalTest test =
      read("chi2test", "<bsdf type=\"diffuse\"/>\n<bsdf type=\"mirror\"/>\n");
  EXPECT_EQ(test.significance(), 0.01);
  const auto& chi = std::get<ChiSquaredTest>(test.kind);
  EXPECT_EQ(chi.resolution, 10);
  EXPECT_EQ(chi.least_expected, 5);
  EXPECT_EQ(chi.sample_count, -1);
  EXPECT_EQ(chi.direction_count, 5);
  ASSERT_EQ(test.bsdfs.size(), 2U);
  EXPECT_EQ(test.bsdfs[1].title, "bsdf \"mirror\"");
  EXPECT_EQ(test.bsdfs[1].where.line, 3);
  EXPECT_TRUE(std::holds_alternative<bsdf::Mirror>(test.bsdfs[1].bsdf));
  EXPECT_EQ(test.case_count(), 10U);
}

TEST_F(TestReaderTest, PropertiesOfTheChiSquaredTest) {
  const StatisticalTest test = read(
      "chi2test",
      "<float name=\"significanceLevel\" value=\"0.05\"/><integer name=\"resolution\" value=\"7\"/>"
      "<integer name=\"minExpFrequency\" value=\"9\"/><integer name=\"sampleCount\" "
      "value=\"1000\"/>"
      "<integer name=\"testCount\" value=\"3\"/><bsdf type=\"diffuse\"/>");
  EXPECT_EQ(test.significance(), 0.05);
  const auto& chi = std::get<ChiSquaredTest>(test.kind);
  EXPECT_EQ(chi.resolution, 7);
  EXPECT_EQ(chi.least_expected, 9);
  EXPECT_EQ(chi.sample_count, 1000);
  EXPECT_EQ(chi.direction_count, 3);
}

TEST_F(TestReaderTest, ListsAreSplitAtBlanksAndCommas) {
  const StatisticalTest test = read("ttest", angles + references("1, 2\n\t 3 ,4") +
                                                 "<bsdf type=\"diffuse\"/><bsdf type=\"mirror\"/>");
  const auto& t = std::get<TTest>(test.kind);
  EXPECT_EQ(t.angles, (std::vector<double>{0, 45}));
  EXPECT_EQ(t.references, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(t.sample_count, 100000);
  EXPECT_EQ(test.significance(), 0.01);
  EXPECT_EQ(test.case_count(), 4U);
}

TEST_F(TestReaderTest, HoldsScenes) {
  folder_.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const StatisticalTest test = read(
      "ttest",
      references("1 2") + scene +
          "<scene><camera type=\"perspective\"/><integrator type=\"path\"/>"
          "<mesh type=\"obj\"><string name=\"filename\" value=\"triangle.obj\"/></mesh></scene>");
  ASSERT_EQ(test.scenes.size(), 2U);
  EXPECT_EQ(test.scenes[0].scene.camera.width, 7);
  EXPECT_EQ(test.scenes[0].where.line, 3);
  EXPECT_EQ(test.scenes[1].scene.triangle_count(), 1U) << "files lie beside the test file";
  EXPECT_EQ(test.scenes[1].scene.integrator.type.name, "path");
  EXPECT_EQ(test.case_count(), 2U);
}

TEST_F(TestReaderTest, NumbersOfReferencesMustFit) {
  const std::string bsdf = "<bsdf type=\"diffuse\"/>\n";
  expect_error("ttest", angles + references("1") + bsdf, 3,
               {"\"references\"", "1 numbers", "2 angles", "1 BSDFs"});
  expect_error("ttest", angles + references("1 2") + bsdf + bsdf, 3, {"2 numbers", "2 BSDFs"});
  expect_error("ttest", angles + bsdf, 1, {"\"references\"", "0 numbers"});
  expect_error("ttest", references("1") + bsdf, 1, {"\"angles\"", "missing"});
  expect_error("ttest", references("1 2") + scene, 2, {"2 numbers for 1 scenes"});
  expect_error("ttest", angles + references("1") + scene, 2, {"\"angles\"", "scenes"});
}

TEST_F(TestReaderTest, SubjectsMustFit) {
  expect_error("chi2test", scene, 2, {"test \"chi2test\"", "cannot hold a scene"});
  expect_error("ttest", angles + references("1 2") + "<bsdf type=\"diffuse\"/>\n" + scene, 5,
               {"both"});
  expect_error("ttest", "", 1, {"nothing to test"});
  expect_error("ttest", references("1") + "<scene>\n<camera type=\"perspective\"/></scene>", 3,
               {"no integrator"});
  expect_error("ttest", references("1") + "<scene>\n<integrator type=\"path\"/></scene>", 3,
               {"no camera"});
  expect_error("chi2test",
               "<bsdf type=\"diffuse\">\n<texture type=\"checker\" name=\"albedo\"/></bsdf>", 2,
               {"cannot have textures"});
  expect_error("chi2test", "<bsdf type=\"diffuse\"/>\n<camera type=\"perspective\"/>", 3,
               {"cannot hold a <camera>"});
}

TEST_F(TestReaderTest, MistakesAreFoundWithTheirLine) {
  const std::string bsdf = "<bsdf type=\"diffuse\"/>\n";
  expect_error("chi2tst", bsdf, 1, {"\"chi2tst\"", "did you mean \"chi2test\"?"});
  expect_error("chi2test", "<bsdf type=\"difuse\"/>", 2, {"did you mean \"diffuse\"?"});
  expect_error("ttest", "<string name=\"angles\" value=\"0, x5\"/>" + bsdf, 2,
               {"\"x5\"", "no number"});
  expect_error("ttest", "<string name=\"angles\" value=\"200\"/>" + bsdf, 2,
               {"200", "180 degrees"});
  expect_error("ttest", "<float name=\"angles\" value=\"20\"/>" + bsdf, 2, {"must be a <string>"});
  expect_error("chi2test", "<integer name=\"sampleCount\" value=\"0\"/>" + bsdf, 2, {"5000 a bin"});
  expect_error("chi2test", "<float name=\"significanceLevel\" value=\"1\"/>" + bsdf, 2,
               {"less than 1"});
  expect_error("chi2test", "<float name=\"significanceLevel\" value=\"0\"/>" + bsdf, 2,
               {"significanceLevel"});
  expect_error("chi2test", "<integer name=\"resolution\" value=\"0\"/>" + bsdf, 2, {"resolution"});
}

TEST_F(TestReaderTest, UnknownPropertiesAreWarnings) {
  Diagnostics diagnostics;
  (void)read("chi2test", "<integer name=\"testcount\" value=\"1\"/>\n<bsdf type=\"diffuse\"/>",
             diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  expect_message(diagnostics.warnings()[0], place(folder_.file("test.xml"), 2),
                 {"\"testcount\"", "did you mean \"testCount\"?"});
  Diagnostics strict(true);
  const std::string content = "<integer name=\"angles\" value=\"1\"/>\n<bsdf type=\"diffuse\"/>";
  expect_message(input_error_of([&] { return read("chi2test", content, strict); }),
                 place(folder_.file("test.xml"), 2), {"\"angles\"", "--strict"});
}

TEST_F(TestReaderTest, ScenesAndTestsAreToldApart) {
  Diagnostics diagnostics;
  const auto test_file =
      folder_.write("test.xml", "<test type=\"chi2test\"><bsdf type=\"diffuse\"/></test>");
  expect_message(input_error_of([&] { return read_scene(test_file, diagnostics); }),
                 place(test_file, 1), {"<test>", "facet test"});
  const auto scene_file = folder_.write("scene.xml", scene);
  expect_message(input_error_of([&] { return read_test(scene_file, diagnostics); }),
                 place(scene_file, 1), {"<scene>", "facet render"});
  const auto other = folder_.write("other.xml", "<bsdf type=\"diffuse\"/>");
  expect_message(input_error_of([&] { return read_test(other, diagnostics); }), place(other, 1),
                 {"<bsdf>", "<test> expected"});
}

}  // namespace

}  // namespace facet
