// `facet test`: outcomes, reports, pictures, mistakes; and the tests that ship.
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "cli/program.h"
#include "image/files.h"

namespace facet::test {

namespace {

/// A test of albedos; the content begins on line 4.
std::string albedo_test(const std::string& references, const std::string& content) {
  return "<test type=\"ttest\">\n<string name=\"angles\" value=\"0 60\"/><integer "
         "name=\"sampleCount\" "
         "value=\"1000\"/>\n<string name=\"references\" value=\"" +
         references + "\"/>\n" + content + "</test>\n";
}

/// A test that fails: no sample of a mirror lies in a bin, so that there is nothing to test.
const std::string failing_chi2_test =
    "<test type=\"chi2test\"><integer name=\"testCount\" value=\"1\"/>\n<bsdf type=\"diffuse\"/>\n"
    "<bsdf type=\"mirror\"/></test>";

class TestCliTest : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    folder_.write("good.xml", albedo_test("0.5, 0.5, 1 1",
                                          "<bsdf type=\"diffuse\"/><bsdf type=\"mirror\"/>\n"));
    folder_.write("bad.xml", albedo_test("0.5 0.6", "<bsdf type=\"diffuse\"/>\n"));
    folder_.write("chi2.xml", failing_chi2_test);
  }
};

TEST_F(TestCliTest, OneLineACase) {
  const Result result = run({"test", "good.xml"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 5);
  expect_words(result.out, {"good.xml: bsdf \"diffuse\" (line 4) at 60 degrees: t = ",
                            "mean 0.5, reference 0.5", "p = ", "bsdf \"mirror\"", ", passed\n",
                            "\n4 of 4 passed\n"});
  expect_words(result.err, {"good.xml: 4 cases"});
  EXPECT_EQ(run({"test", "good.xml", "--quiet"}).err, "");
}

TEST_F(TestCliTest, AFailureExitsWith1) {
  const Result result = run({"test", "good.xml", "bad.xml"});
  EXPECT_EQ(result.code, 1) << result.err;
  expect_words(result.out, {"bad.xml: bsdf \"diffuse\" (line 4) at 60 degrees: t = -", "FAILED",
                            "5 of 6 passed"});
}

TEST_F(TestCliTest, AFailedChiSquaredTestLeavesAPicture) {
  const Result result = run({"test", "chi2.xml"});
  EXPECT_EQ(result.code, 1) << result.err;
  expect_words(result.out, {"chi2 = ", "99 degrees of freedom", "FAILED: nothing to test",
                            "histograms in chi2-case2.png", "1 of 2 passed"});
  const Image picture = read_image(folder_.file("chi2-case2.png"));
  EXPECT_GE(picture.width(), 200);
  EXPECT_GT(picture.height(), picture.width());
  EXPECT_FALSE(std::filesystem::exists(folder_.file("chi2-case1.png"))) << "that case passed";
  std::filesystem::create_directory(folder_.file("pictures"));
  EXPECT_EQ(run({"test", "chi2.xml", "--pictures", "pictures"}).code, 1);
  EXPECT_TRUE(std::filesystem::exists(folder_.file("pictures/chi2-case2.png")));
}

TEST_F(TestCliTest, JUnitReport) {
  EXPECT_EQ(run({"test", "good.xml", "bad.xml", "chi2.xml", "--junit", "report.xml"}).code, 1);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file(folder_.file("report.xml").c_str()));
  const pugi::xml_node suites = document.child("testsuites");
  const pugi::xml_node good = suites.find_child_by_attribute("name", "good.xml");
  EXPECT_EQ(good.attribute("tests").as_int(), 4);
  EXPECT_EQ(good.attribute("failures").as_int(), 0);
  EXPECT_FALSE(good.child("testcase").child("failure"));
  const pugi::xml_node bad = suites.find_child_by_attribute("name", "bad.xml");
  EXPECT_EQ(bad.attribute("failures").as_int(), 1);
  const pugi::xml_node failed = bad.child("testcase").next_sibling();
  EXPECT_EQ(failed.attribute("line").as_int(), 4);
  EXPECT_NE(std::string(failed.child("failure").attribute("message").value()).find("t = -"),
            std::string::npos);
  const pugi::xml_node chi2 = suites.find_child_by_attribute("name", "chi2.xml");
  EXPECT_STREQ(chi2.last_child().child_value("failure"), "picture: chi2-case2.png");
}

TEST_F(TestCliTest, JsonReport) {
  const Result result = run({"test", "bad.xml", "--json", "-", "--seed", "5"});
  EXPECT_EQ(result.code, 1);
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["seed"], 5);
  EXPECT_EQ(json["passed"], 1);
  EXPECT_EQ(json["total"], 2);
  EXPECT_EQ(json["cases"][1]["line"], 4);
  EXPECT_EQ(json["cases"][1]["reference"], 0.6);
  EXPECT_EQ(json["cases"][1]["passed"], false);
  EXPECT_EQ(json["cases"][0]["test"], "ttest");
}

TEST_F(TestCliTest, ScenesAndTheirMean) {
  write_scene("scene.xml", floor());
  std::string scene = folder_.read("scene.xml");
  scene.insert(scene.find("<integrator"), "<emitter type=\"environment\"/>\n");
  const auto test_of = [&](const std::string& reference) {
    return "<test type=\"ttest\"><string name=\"references\" value=\"" + reference + "\"/>" +
           scene + "</test>";
  };
  // A floor of albedo 1/2 under a sky of 1; the camera looks at nothing else.
  scene.replace(scene.find("0.1 0.8 -4"), 10, "0 0.1 0");
  scene.replace(scene.find("0 0.4 0"), 7, "0 0 0.0");
  scene.replace(scene.find("up=\"0 1 0\""), 10, "up=\"0 0 1\"");
  folder_.write("sky.xml", test_of("0.5"));
  folder_.write("wrong.xml", test_of("0.502"));
  for (const std::vector<std::string>& backend :
       {std::vector<std::string>{},
        {"--backend", "reference"},
        {"--backend", "reference", "--precision", "double"}}) {
    std::vector<std::string> arguments{"test", "sky.xml"};
    arguments.insert(arguments.end(), backend.begin(), backend.end());
    EXPECT_EQ(run(arguments).code, 0);
    arguments[1] = "wrong.xml";
    const Result result = run(arguments);
    EXPECT_EQ(result.code, 1);
    expect_words(result.out, {"scene 1 (line 1), direct_mis", "reference 0.502", "0 of 1 passed"});
  }
}

TEST_F(TestCliTest, MistakesExitWith2AndALine) {
  folder_.write("broken.xml", albedo_test("1", "<bsdf type=\"difuse\"/>\n"));
  expect_failure({"test", "good.xml", "broken.xml"}, 2,
                 {"broken.xml:4: ", "did you mean \"diffuse\"?"});
  folder_.write("numbers.xml", albedo_test("1", "<bsdf type=\"diffuse\"/>\n"));
  expect_failure({"test", "numbers.xml"}, 2, {"numbers.xml:3: ", "\"references\""});
  expect_failure({"test", "missing.xml"}, 2, {"missing.xml"});
  expect_failure({"test", "scene.xml"}, 2, {"scene.xml:1: ", "facet render"});
  expect_failure({"render", "good.xml"}, 2, {"good.xml:1: ", "facet test"});
  expect_failure({"test"}, 2, {"files", "facet test --help"});
  expect_failure({"test", "good.xml", "--precision", "double"}, 2, {"--backend reference"});
  expect_failure({"test", "good.xml", "--pictures", "nowhere"}, 2, {"--pictures nowhere"});
  expect_failure({"test", "good.xml", "--junit", "no/such/report.xml"}, 2, {"no/such"});
  folder_.write(
      "odd.xml",
      albedo_test("0.5 0.5", "<float name=\"alpha\" value=\"1\"/><bsdf type=\"diffuse\"/>"));
  const Result odd = run({"test", "odd.xml", "--quiet"});
  EXPECT_EQ(odd.code, 0);
  expect_words(odd.err, {"warning: ", "odd.xml:4: ", "\"alpha\""});
  expect_failure({"test", "odd.xml", "--strict"}, 2, {"odd.xml:4: ", "--strict"});
}

TEST_F(TestCliTest, NeedsADeviceUnlessTheReferenceRuns) {
  const std::vector<std::string> no_driver{"VK_DRIVER_FILES=/nonexistent",
                                           "VK_ICD_FILENAMES=/nonexistent"};
  EXPECT_EQ(run({"test", "good.xml"}, no_driver).code, 3);
  EXPECT_EQ(run({"test", "good.xml", "--backend", "reference"}, no_driver).code, 0);
}

TEST_F(TestCliTest, TheSeedDecides) {
  folder_.write("lobe.xml",
                "<test type=\"chi2test\"><integer name=\"testCount\" value=\"1\"/><integer "
                "name=\"sampleCount\" value=\"10000\"/><bsdf type=\"microfacet\"/></test>");
  const std::vector<std::string> arguments{"test", "lobe.xml", "--seed", "3"};
  const std::string once = run(arguments).out;
  EXPECT_EQ(run(arguments).out, once);
  EXPECT_NE(run({"test", "lobe.xml", "--seed", "4"}).out, once);
}

/// All tests that ship, on one backend.
class ShippedTests : public CliTest,
                     public ::testing::WithParamInterface<std::vector<std::string>> {};

TEST_P(ShippedTests, Pass) {
  std::vector<std::string> arguments{"test"};
  for (const auto& entry : std::filesystem::directory_iterator(FACET_SCENES "/tests")) {
    if (entry.path().extension() == ".xml") arguments.push_back(entry.path().string());
  }
  std::sort(arguments.begin() + 1, arguments.end());
  ASSERT_GE(arguments.size(), 5U);
  arguments.insert(arguments.end(), GetParam().begin(), GetParam().end());
  const Result result = run(arguments);
  EXPECT_EQ(result.code, 0) << result.out << result.err;
}

INSTANTIATE_TEST_SUITE_P(Backends, ShippedTests,
                         ::testing::Values(std::vector<std::string>{"--validate"},
                                           std::vector<std::string>{"--backend", "reference"},
                                           std::vector<std::string>{"--backend", "reference",
                                                                    "--precision", "double"}));

}  // namespace

}  // namespace facet::test
