// Numbers, lists, transforms and typed properties of the scene language.
#include <gtest/gtest.h>

#include "core/text.h"
#include "scene/xml/property_reader.h"
#include "scene/xml/values.h"
#include "support/input.h"

namespace facet {

namespace {

using test::expect_message;
using test::input_error_of;
using test::place;

/// An XML file of one element, on the first line.
class XmlValuesTest : public ::testing::Test {
 protected:
  const XmlDocument& open(const std::string& text) {
    document_.emplace(folder_.write("values.xml", text));
    return *document_;
  }
  std::vector<double> numbers(const std::string& value, std::size_t least, std::size_t most) {
    const XmlDocument& xml = open("<color value=\"" + value + "\"/>");
    return read_numbers(xml, xml.root(), "value", least, most);
  }
  dmat4 transform(const std::string& steps) {
    const XmlDocument& xml = open("<transform name=\"toWorld\">" + steps + "</transform>");
    return read_transform(xml, xml.root());
  }
  dvec3 transformed(const std::string& steps, const dvec3& point) {
    return dvec3(transform(steps) * glm::dvec4(point, 1));
  }
  void expect_error(const std::string& steps, std::initializer_list<const char*> words,
                    int line = 1) {
    const std::string message = input_error_of([&] { return transform(steps); });
    expect_message(message, place(folder_.file("values.xml"), line), words);
  }
  PropertyReader properties(const std::string& content) {
    const XmlDocument& xml = open("<bsdf type=\"diffuse\">\n" + content + "\n</bsdf>");
    return {xml, xml.root()};
  }
  template <typename Call>
  void expect_property_error(const std::string& content, const Call& call,
                             std::initializer_list<const char*> words, int line = 2) {
    const std::string message = input_error_of([&] {
      PropertyReader p = properties(content);
      return call(p);
    });
    expect_message(message, place(folder_.file("values.xml"), line), words);
  }

  test::TemporaryFolder folder_;
  std::optional<XmlDocument> document_;
};

void expect_near(const dvec3& actual, const dvec3& expected) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-12) << "component " << i;
}

TEST_F(XmlValuesTest, ListsAreSplitAtCommasAndBlanks) {
  const std::vector<double> expected{1, -2.5, 3e-2};
  for (const char* text :
       {"1 -2.5 3e-2", "1,-2.5,3e-2", "1, -2.5, 3e-2", "  1\t-2.5\n3e-2  ", "1 ,, -2.5 , +3e-2,"})
    EXPECT_EQ(numbers(text, 3, 3), expected) << text;
}

TEST_F(XmlValuesTest, MalformedNumbersAreNamed) {
  for (const char* text : {"1.0f",
                           "nan",
                           "-nan",
                           "inf",
                           "infinity",
                           "1e999",
                           "-1e999",
                           "0x10",
                           "1.2.3",
                           "one",
                           "1;2",
                           "--1",
                           "+-1",
                           "++1",
                           "1e",
                           "1_000",
                           "1'000",
                           "\xc2\xa0"
                           "1",
                           "-",
                           "+",
                           "."}) {
    const std::string message = input_error_of([&] { return numbers(text, 1, 1); });
    expect_message(message, place(folder_.file("values.xml"), 1),
                   {"<color>", "is not a number", text});
  }
}

TEST_F(XmlValuesTest, TooFewAndTooManyNumbersAreCounted) {
  const std::string where = place(folder_.file("values.xml"), 1);
  expect_message(input_error_of([&] { return numbers("1 2", 3, 3); }), where,
                 {"holds 2 numbers", "3 expected"});
  expect_message(input_error_of([&] { return numbers("1 2 3 4", 3, 3); }), where,
                 {"holds 4 numbers", "3 expected"});
  expect_message(input_error_of([&] { return numbers("", 1, 3); }), where,
                 {"holds 0 numbers", "1 or 3 expected"});
}

TEST_F(XmlValuesTest, TinyNumbersAreNotErrors) {
  EXPECT_EQ(numbers("1e-30", 1, 1), std::vector<double>{1e-30});
  EXPECT_EQ(numbers("-0", 1, 1), std::vector<double>{0});
}

TEST_F(XmlValuesTest, AnEmptyTransformIsTheIdentity) { EXPECT_EQ(transform(""), dmat4(1)); }

TEST_F(XmlValuesTest, StepsAreMultipliedOnTheLeft) {
  const char* scale_then_move = "<scale value=\"2 3 4\"/><translate value=\"1 1 1\"/>";
  const char* move_then_scale = "<translate value=\"1 1 1\"/><scale value=\"2 3 4\"/>";
  expect_near(transformed(scale_then_move, {1, 1, 1}), {3, 4, 5});
  expect_near(transformed(move_then_scale, {1, 1, 1}), {4, 6, 8});
}

TEST_F(XmlValuesTest, OneNumberScalesAllAxes) {
  expect_near(transformed("<scale value=\"2.5\"/>", {1, 2, 3}), {2.5, 5, 7.5});
  expect_error("<scale value=\"1 2\"/>", {"<scale>", "one or three"});
}

TEST_F(XmlValuesTest, RotationIsRightHandedInDegreesAboutANormalisedAxis) {
  for (const char* axis : {"0 0 1", "0 0 7", "0,0,1e-5"}) {
    const std::string step = std::string("<rotate angle=\"90\" axis=\"") + axis + "\"/>";
    expect_near(transformed(step, {1, 0, 0}), {0, 1, 0});
  }
  expect_near(transformed("<rotate angle=\"120\" axis=\"1 1 1\"/>", {1, 2, 3}), {3, 1, 2});
  expect_error("<rotate angle=\"90\" axis=\"0 0 0\"/>", {"<rotate>", "axis"});
}

TEST_F(XmlValuesTest, ExtremeAxesStillGiveADirection) {
  for (const char* axis : {"0 0 1e-200", "0 0 1e200"}) {
    const std::string step = std::string("<rotate angle=\"90\" axis=\"") + axis + "\"/>";
    expect_near(transformed(step, {1, 0, 0}), {0, 1, 0});
  }
}

TEST_F(XmlValuesTest, MatricesAreRowMajor) {
  const dmat4 m = transform("<matrix value=\"1 2 3 4  5 6 7 8  9 10 11 12  0 0 0 1\"/>");
  expect_near(dvec3(m * glm::dvec4(1, 0, 0, 0)), {1, 5, 9});
  expect_near(dvec3(m * glm::dvec4(0, 0, 0, 1)), {4, 8, 12});
  expect_error("<matrix value=\"1 0 0\"/>", {"<matrix>", "holds 3 numbers", "16 expected"});
}

TEST_F(XmlValuesTest, LookatColumnsAreLeftUpDirectionOrigin) {
  // up is neither a unit vector nor perpendicular to the direction of view.
  const dmat4 m = transform("<lookat origin=\"1 2 3\" target=\"1 2 13\" up=\"0 5 2\"/>");
  expect_near(dvec3(m[0]), {1, 0, 0});
  expect_near(dvec3(m[1]), {0, 1, 0});
  expect_near(dvec3(m[2]), {0, 0, 1});
  expect_near(dvec3(m[3]), {1, 2, 3});
  const dmat4 sideways = transform("<lookat origin=\"0 0 0\" target=\"4 0 0\" up=\"0 1 0\"/>");
  expect_near(dvec3(sideways[0]), {0, 0, -1});
  expect_near(dvec3(sideways[2]), {1, 0, 0});
}

TEST_F(XmlValuesTest, ImpossibleLookatsAreErrors) {
  expect_error("<lookat origin=\"1 1 1\" target=\"1 1 1\" up=\"0 1 0\"/>",
               {"<lookat>", "same point"});
  expect_error("<lookat origin=\"0 0 0\" target=\"0 3 0\" up=\"0 1 0\"/>",
               {"<lookat>", "parallel"});
  expect_error("<lookat origin=\"0 0 0\" target=\"0 3 0\" up=\"0 0 0\"/>", {"<lookat>", "up"});
  expect_error("<lookat origin=\"0 0 0\" up=\"0 1 0\"/>", {"<lookat>", "lacks", "target"});
}

TEST_F(XmlValuesTest, UnknownStepsAndTextInTransformsAreErrors) {
  expect_error("\n<tranlate value=\"0 0 0\"/>",
               {"<tranlate>", "not a step", "did you mean \"translate\"?"}, 2);
  expect_error("\n<scale value=\"2\"/>\nstray", {"stray text"}, 3);
}

TEST_F(XmlValuesTest, PropertiesAreHandedOutByNameAndType) {
  PropertyReader p = properties(
      "<float name=\"f\" value=\" 0.25 \"/><integer name=\"i\" value=\"-3\"/><string name=\"s\" "
      "value=\"a "
      "b\"/>"
      "<color name=\"c\" value=\"1,2,3\"/><color name=\"grey\" value=\"0.5\"/>"
      "<transform name=\"t\"><scale value=\"2\"/></transform>");
  EXPECT_EQ(p.real("f", 1), 0.25);
  EXPECT_EQ(p.integer("i", 0, -10, 10), -3);
  EXPECT_EQ(p.string("s", ""), "a b");
  EXPECT_EQ(p.color("c", Color(0)), Color(1, 2, 3));
  EXPECT_EQ(p.color("grey", Color(0)), Color(0.5F));
  EXPECT_EQ(p.transform("t"), glm::dmat4(glm::dmat3(2)));
  EXPECT_EQ(p.title(), "bsdf \"diffuse\"");
}

TEST_F(XmlValuesTest, AbsentPropertiesTakeTheirDefaults) {
  PropertyReader p = properties("");
  EXPECT_EQ(p.real("f", 7), 7);
  EXPECT_EQ(p.integer("i", 8, 0, 10), 8);
  EXPECT_EQ(p.string("s", "x"), "x");
  EXPECT_EQ(p.color("c", Color(1, 2, 3)), Color(1, 2, 3));
  EXPECT_EQ(p.transform("t"), dmat4(1));
  EXPECT_EQ(p.choice("w", {"first", "second"}), "first");
}

TEST_F(XmlValuesTest, WrongTypesNameBoth) {
  const char* text = "<string name=\"alpha\" value=\"0.1\"/>";
  const auto words = {"bsdf \"diffuse\"", "\"alpha\"", "must be a <float>, not a <string>"};
  expect_property_error(
      text, [](PropertyReader& p) { return p.real("alpha", 0); }, words);
}

TEST_F(XmlValuesTest, MalformedPropertiesAreErrors) {
  const auto integer = [](PropertyReader& p) { return p.integer("x", 0, 0, 100); };
  for (const char* value : {"1.5", "1e2", "abc", "", "99999999999999999999"}) {
    const std::string text = std::string("<integer name=\"x\" value=\"") + value + "\"/>";
    expect_property_error(text, integer, {"\"x\"", value, "not an integer"});
  }
  expect_property_error("<integer name=\"x\" value=\"101\"/>", integer, {"101", "0 to 100"});
  expect_property_error("<integer name=\"x\"/>", integer, {"<integer>", "lacks", "\"value\""});
  expect_property_error("<integer value=\"1\"/>", integer, {"<integer>", "lacks", "\"name\""});
}

TEST_F(XmlValuesTest, ColoursAreOneOrThreeNumbers) {
  const auto color = [](PropertyReader& p) { return p.color("c", Color(0)); };
  expect_property_error("<color name=\"c\" value=\"1 2\"/>", color,
                        {"two numbers", "one or three"});
  expect_property_error("<color name=\"c\" value=\"1 2 3 4\"/>", color, {"holds 4 numbers"});
}

TEST_F(XmlValuesTest, ColoursBeyondFloatsAreErrors) {
  const auto radiance = [](PropertyReader& p) { return p.radiance("c", Color(0)); };
  expect_property_error("<color name=\"c\" value=\"1e39\"/>", radiance, {"\"c\""});
}

TEST_F(XmlValuesTest, RangesOfPhysicalProperties) {
  const auto reflectance = [](PropertyReader& p) { return p.reflectance("a", Color(0)); };
  const auto alpha = [](PropertyReader& p) { return p.roughness("a", 0.1F); };
  const auto ior = [](PropertyReader& p) { return p.index_of_refraction("a", 1); };
  expect_property_error("<color name=\"a\" value=\"0.5 1.01 0\"/>", reflectance,
                        {"1.01", "between 0 and 1"});
  expect_property_error("<color name=\"a\" value=\"-0.1\"/>", reflectance,
                        {"-0.1", "between 0 and 1"});
  expect_property_error("<float name=\"a\" value=\"0\"/>", alpha, {"smooth", "mirror"});
  expect_property_error("<float name=\"a\" value=\"1.5\"/>", alpha, {"1.5", "at most 1"});
  expect_property_error("<float name=\"a\" value=\"0\"/>", ior, {"but must be"});
}

TEST_F(XmlValuesTest, ChoicesSuggestTheNearestWord) {
  const auto choice = [](PropertyReader& p) { return p.choice("h", {"balance", "power"}); };
  const auto words = {"\"balence\"", "balance, power", "did you mean \"balance\"?"};
  expect_property_error("<string name=\"h\" value=\"balence\"/>", choice, words);
}

TEST(TextTest, NearestNameIsFoundOnlyWhenItIsNear) {
  const std::vector<std::string> names{"albedo", "alpha", "intIOR"};
  EXPECT_EQ(nearest_name("albeod", names), "albedo");
  EXPECT_EQ(nearest_name("aplha", names), "alpha");
  EXPECT_EQ(nearest_name("intior", names), std::nullopt) << "three of six letters differ";
  EXPECT_EQ(nearest_name("radiance", names), std::nullopt);
  EXPECT_EQ(nearest_name("", names), std::nullopt);
}

TEST(TextTest, UnitPrefixes) {
  EXPECT_EQ(with_unit_prefix(0), "0");
  EXPECT_EQ(with_unit_prefix(999), "999");
  EXPECT_EQ(with_unit_prefix(1234567), "1.23 M");
}

}  // namespace

}  // namespace facet
