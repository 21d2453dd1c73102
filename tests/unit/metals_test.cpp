// Metals by name: the reduction of measured spectra to three channels, and how scenes ask for them.
#include "scene/bsdf/metals.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "render/pack/parameter_records.h"
#include "scene/plugin/parameter_reader.h"
#include "scene/xml/property_reader.h"
#include "support/input.h"

namespace facet {

namespace {

using test::expect_message;
using test::input_error_of;
using test::place;

/// The CIE's own table of its standard observer of 1931, every 10 nm from 380 to 750 nm.
constexpr std::array<std::array<double, 3>, 38> observer{
    {{.0014, .0000, .0065},  {.0042, .0001, .0201},  {.0143, .0004, .0679},  {.0435, .0012, .2074},
     {.1344, .0040, .6456},  {.2839, .0116, 1.3856}, {.3483, .0230, 1.7471}, {.3362, .0380, 1.7721},
     {.2908, .0600, 1.6692}, {.1954, .0910, 1.2876}, {.0956, .1390, .8130},  {.0320, .2080, .4652},
     {.0049, .3230, .2720},  {.0093, .5030, .1582},  {.0633, .7100, .0782},  {.1655, .8620, .0422},
     {.2904, .9540, .0203},  {.4334, .9950, .0087},  {.5945, .9950, .0039},  {.7621, .9520, .0021},
     {.9163, .8700, .0017},  {1.0263, .7570, .0011}, {1.0622, .6310, .0008}, {1.0026, .5030, .0003},
     {.8544, .3810, .0002},  {.6424, .2650, .0000},  {.4479, .1750, .0000},  {.2835, .1070, .0000},
     {.1649, .0610, .0000},  {.0874, .0320, .0000},  {.0468, .0170, .0000},  {.0227, .0082, .0000},
     {.0114, .0041, .0000},  {.0058, .0021, .0000},  {.0029, .0010, .0000},  {.0014, .0005, .0000},
     {.0007, .0002, .0000},  {.0003, .0001, .0000}}};
constexpr std::array<std::array<double, 3>, 3> to_rec709{{{3.2404542, -1.5371385, -0.4985314},
                                                          {-0.9692660, 1.8760108, 0.0415560},
                                                          {0.0556434, -0.2040259, 1.0572252}}};

double reflectance(double n, double k) {
  return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
}

double at(const MetalSpectrum& metal, const std::vector<double>& values, double w) {
  std::size_t i = 1;
  while (i + 1 < values.size() && metal.wavelengths[i] < w) ++i;
  const double x = metal.wavelengths[i - 1];
  return values[i - 1] + (values[i] - values[i - 1]) * (w - x) / (metal.wavelengths[i] - x);
}

/// The spectrum of a function of n and k as a colour, a constant's being that constant.
template <typename Function>
dvec3 color_of(const MetalSpectrum& metal, const Function& f) {
  dvec3 sum(0);
  dvec3 white(0);
  for (std::size_t i = 0; i < observer.size(); ++i) {
    const double w = 380 + 10.0 * static_cast<double>(i);
    const double value = f(at(metal, metal.n, w), at(metal, metal.k, w));
    for (int channel = 0; channel < 3; ++channel) {
      const auto& row = to_rec709.at(static_cast<std::size_t>(channel));
      const double weight =
          row[0] * observer[i][0] + row[1] * observer[i][1] + row[2] * observer[i][2];
      sum[channel] += weight * value;
      white[channel] += weight;
    }
  }
  return sum / white;
}

TEST(Metals, EveryMetalsAveragesAreThoseUnderTheTabulatedObserver) {
  ASSERT_EQ(metal_names().size(), 12U);
  for (const MetalSpectrum& metal : metal_spectra()) {
    const auto ior = find_metal(metal.name);
    ASSERT_TRUE(ior) << metal.name;
    const dvec3 n = color_of(metal, [](double value, double) { return value; });
    const dvec3 k = color_of(metal, [](double, double value) { return value; });
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(ior->eta[c], n[c], 0.03) << metal.name << c;
      EXPECT_NEAR(ior->k[c], k[c], 0.03) << metal.name << c;
      EXPECT_GT(ior->eta[c], 0.03) << metal.name << c;
    }
  }
}

TEST(Metals, ReflectancesAtNormalIncidenceAreNearlyTheSpectrums) {
  // Gold's red is outside of Rec. 709, and gold's and copper's spectra have a step.
  const std::map<std::string_view, dvec3> tolerances{{"Au", {0.045, 0.02, 0.015}},
                                                     {"Cu", {0.015, 0.01, 0.005}}};
  for (const MetalSpectrum& metal : metal_spectra()) {
    const ConductorIor ior = find_metal(metal.name).value();
    const dvec3 expected = color_of(metal, reflectance);
    const auto known = tolerances.find(metal.name);
    const dvec3 tolerance = known == tolerances.end() ? dvec3(0.003) : known->second;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(reflectance(ior.eta[c], ior.k[c]), expected[c], tolerance[c]) << metal.name << c;
  }
}

TEST(Metals, GoldIsAboutWhatOtherRenderersHave) {
  // Theirs: another measurement, without the scale that gives 1 for a constant: (1.20, 0.95, 0.91).
  const ConductorIor gold = find_metal("Au").value();
  const Color scale(1.2048F, 0.9483F, 0.9088F);
  const std::array<float, 3> eta{0.1431F, 0.3750F, 1.4425F};
  const std::array<float, 3> k{3.9832F, 2.3857F, 1.6032F};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(gold.eta[c] * scale[c], eta.at(static_cast<std::size_t>(c)), 0.11);
    EXPECT_NEAR(gold.k[c] * scale[c], k.at(static_cast<std::size_t>(c)), 0.26);
  }
}

TEST(Metals, SpectraCoverWhatIsVisibleInOrder) {
  for (const MetalSpectrum& metal : metal_spectra()) {
    ASSERT_EQ(metal.n.size(), metal.wavelengths.size()) << metal.name;
    ASSERT_EQ(metal.k.size(), metal.wavelengths.size()) << metal.name;
    EXPECT_LE(metal.wavelengths.front(), 380) << metal.name;
    EXPECT_GE(metal.wavelengths.back(), 750) << metal.name;
    EXPECT_TRUE(std::is_sorted(metal.wavelengths.begin(), metal.wavelengths.end())) << metal.name;
  }
  EXPECT_FALSE(find_metal("Unobtainium"));
}

class ConductorTest : public ::testing::Test {
 protected:
  bsdf::RoughConductor read(const std::string& content) {
    const XmlDocument xml(
        folder_.write("c.xml", "<bsdf type=\"roughconductor\">\n" + content + "\n</bsdf>"));
    PropertyReader properties(xml, xml.root(), [](const pugi::xml_node&, float) { return 0U; });
    const auto conductor = read_parameters<bsdf::RoughConductor>(properties);
    Diagnostics diagnostics;
    properties.finish(diagnostics);
    EXPECT_TRUE(diagnostics.warnings().empty());
    return conductor;
  }
  void expect_error(const std::string& content, std::initializer_list<const char*> words) {
    const std::string message = input_error_of([&] { return read(content); });
    expect_message(message, place(folder_.file("c.xml"), 2), words);
  }

  test::TemporaryFolder folder_;
};

const std::string gold = "<string name=\"material\" value=\"Au\"/>";
const std::string eta = "<color name=\"eta\" value=\"0.2, 0.9, 1.1\"/>";
const std::string k = "<color name=\"k\" value=\"0, 2, 3\"/>";

TEST_F(ConductorTest, AMetalReplacesR0) {
  const auto conductor = read(gold + "<float name=\"alpha\" value=\"0.25\"/>");
  ASSERT_TRUE(conductor.ior());
  const ConductorIor expected = find_metal("Au").value();
  const shared::BsdfRecord record = pack_bsdf(conductor);
  EXPECT_EQ(record.flags, shared::BSDF_CONDUCTOR);
  EXPECT_EQ(record.a.w, 0.25F);
  EXPECT_EQ(Color(record.b), expected.eta);
  EXPECT_EQ(Color(record.c), expected.k);
  EXPECT_EQ(pack_bsdf(read("")).flags, 0U);
}

TEST_F(ConductorTest, AnIndexIsGivenByNumbers) {
  const auto conductor = read(eta + k + "<boolean name=\"multiscatter\" value=\"true\"/>");
  const shared::BsdfRecord record = pack_bsdf(conductor);
  EXPECT_EQ(Color(record.b), Color(0.2F, 0.9F, 1.1F));
  EXPECT_EQ(Color(record.c), Color(0, 2, 3));
  EXPECT_EQ(record.flags, shared::BSDF_CONDUCTOR | shared::BSDF_MULTISCATTER);
}

TEST_F(ConductorTest, UnknownMetalsAreErrors) {
  expect_error("<string name=\"material\" value=\"au\"/>",
               {"\"material\" is \"au\"", "none of", "Ag", "Au\"?"});
  expect_error("<string name=\"material\" value=\"unobtainium\"/>", {"none of", "Cu"});
}

TEST_F(ConductorTest, HalfAnIndexIsAnError) {
  expect_error(eta, {"\"eta\" needs \"k\""});
  expect_error(k, {"\"k\" needs \"eta\""});
}

TEST_F(ConductorTest, TwoWordsForOneMetalAreErrors) {
  const std::string r0 = "<color name=\"R0\" value=\"0.5\"/>";
  expect_error(gold + r0, {"\"R0\" excludes"});
  expect_error(eta + k + r0, {"\"R0\" excludes"});
  expect_error(gold + eta + k, {"\"material\" excludes"});
  const std::string texture = "<texture name=\"R0\" type=\"checker\"/>";
  const std::string message = input_error_of([&] { return read(gold + texture); });
  EXPECT_NE(message.find("\"R0\" excludes"), std::string::npos) << message;
}

TEST_F(ConductorTest, IndicesOutOfRangeAreErrors) {
  expect_error("<color name=\"eta\" value=\"0, 1, 1\"/>" + k, {"\"eta\"", "0.001 to 1000"});
  expect_error("<color name=\"eta\" value=\"1, 1, 1e4\"/>" + k, {"\"eta\"", "0.001 to 1000"});
  expect_error(eta + "<color name=\"k\" value=\"1, -1, 1\"/>", {"\"k\"", "0 to 1000"});
}

}  // namespace

}  // namespace facet
