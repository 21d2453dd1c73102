// What the scene reader makes of every BSDF's parameters.
#include <gtest/gtest.h>

#include "scene/reader.h"
#include "support/input.h"

namespace facet {

namespace {

class SceneBsdfTest : public ::testing::Test {
 protected:
  void SetUp() override { folder_.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"); }

  Bsdf read(const std::string& bsdf) {
    const std::string file = "<string name=\"filename\" value=\"triangle.obj\"/>";
    const std::string mesh = "<mesh type=\"obj\">" + file + bsdf + "</mesh>";
    const std::string text = "<scene><camera type=\"perspective\"/>" + mesh + "</scene>";
    return read_scene(folder_.write("scene.xml", text), diagnostics_).bsdfs.at(0);
  }
  template <typename Type>
  Type read_bsdf(const std::string& bsdf) {
    return std::get<Type>(read(bsdf));
  }
  void TearDown() override {
    EXPECT_TRUE(diagnostics_.warnings().empty()) << diagnostics_.warnings()[0];
  }

  test::TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

TEST_F(SceneBsdfTest, Diffuse) {
  EXPECT_EQ(read_bsdf<bsdf::Diffuse>("<bsdf type=\"diffuse\"/>").albedo.value, Color(0.5F));
  const char* text =
      "<bsdf type=\"diffuse\"><color name=\"albedo\" value=\"0.1, 0.2 0.3\"/></bsdf>";
  EXPECT_EQ(read_bsdf<bsdf::Diffuse>(text).albedo.value, Color(0.1F, 0.2F, 0.3F));
}

TEST_F(SceneBsdfTest, RoughConductor) {
  const auto plain = read_bsdf<bsdf::RoughConductor>("<bsdf type=\"roughconductor\"/>");
  EXPECT_EQ(plain.r0.value, Color(0.5F));
  EXPECT_EQ(plain.alpha.value, 0.1F);
  const auto gold = read_bsdf<bsdf::RoughConductor>(
      "<bsdf type=\"roughconductor\"><color name=\"R0\" value=\"1 0.86 0.57\"/><float "
      "name=\"alpha\" "
      "value=\"1\"/></bsdf>");
  EXPECT_EQ(gold.r0.value, Color(1, 0.86F, 0.57F));
  EXPECT_EQ(gold.alpha.value, 1);
}

TEST_F(SceneBsdfTest, RoughSubstrate) {
  const auto plain = read_bsdf<bsdf::RoughSubstrate>("<bsdf type=\"roughsubstrate\"/>");
  EXPECT_EQ(plain.kd.value, Color(0.5F));
  EXPECT_EQ(plain.alpha.value, 0.1F);
  EXPECT_EQ(plain.int_ior, 1.5046F);
  EXPECT_EQ(plain.ext_ior, 1.000277F);
  const auto coat = read_bsdf<bsdf::RoughSubstrate>(
      "<bsdf type=\"roughsubstrate\"><color name=\"kd\" value=\"0.2\"/><float name=\"alpha\" "
      "value=\"0.0001\"/>"
      "<float name=\"intIOR\" value=\"1.7\"/><float name=\"extIOR\" value=\"1.3\"/></bsdf>");
  EXPECT_EQ(coat.kd.value, Color(0.2F));
  EXPECT_EQ(coat.alpha.value, 1e-4F);
  EXPECT_EQ(coat.int_ior, 1.7F);
  EXPECT_EQ(coat.ext_ior, 1.3F);
}

TEST_F(SceneBsdfTest, MirrorAndDielectric) {
  EXPECT_TRUE(std::holds_alternative<bsdf::Mirror>(read("<bsdf type=\"mirror\"/>")));
  const auto plain = read_bsdf<bsdf::Dielectric>("<bsdf type=\"dielectric\"/>");
  EXPECT_EQ(plain.int_ior, 1.5046F);
  EXPECT_EQ(plain.ext_ior, 1.000277F);
  const auto water = read_bsdf<bsdf::Dielectric>(
      "<bsdf type=\"dielectric\"><float name=\"intIOR\" value=\"1.33\"/><float name=\"extIOR\" "
      "value=\"1.5\"/></bsdf>");
  EXPECT_EQ(water.int_ior, 1.33F);
  EXPECT_EQ(water.ext_ior, 1.5F);
}

TEST_F(SceneBsdfTest, Microfacet) {
  const auto plain = read_bsdf<bsdf::Microfacet>("<bsdf type=\"microfacet\"/>");
  EXPECT_EQ(plain.alpha, 0.1F);
  EXPECT_EQ(plain.int_ior, 1.5046F);
  EXPECT_EQ(plain.ext_ior, 1.000277F);
  EXPECT_EQ(plain.kd, Color(0.5F));
  const auto plastic = read_bsdf<bsdf::Microfacet>(
      "<bsdf type=\"microfacet\"><color name=\"kd\" value=\"0.1 0.2 0.3\"/><float name=\"alpha\" "
      "value=\"0.3\"/>"
      "<float name=\"intIOR\" value=\"1.7\"/><float name=\"extIOR\" value=\"1.3\"/></bsdf>");
  EXPECT_EQ(plastic.kd, Color(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(plastic.alpha, 0.3F);
  EXPECT_EQ(plastic.int_ior, 1.7F);
  EXPECT_EQ(plastic.ext_ior, 1.3F);
}

TEST_F(SceneBsdfTest, FresnelBlend) {
  const auto plain = read_bsdf<bsdf::FresnelBlend>("<bsdf type=\"fresnelblend\"/>");
  EXPECT_EQ(plain.rd.value, Color(0.5F));
  EXPECT_EQ(plain.rs.value, Color(0.5F));
  EXPECT_EQ(plain.alpha.value, 0.1F);
  const auto blend = read_bsdf<bsdf::FresnelBlend>(
      "<bsdf type=\"fresnelblend\"><color name=\"Rd\" value=\"0.1\"/><color name=\"Rs\" "
      "value=\"0.2\"/><float "
      "name=\"alpha\" value=\"0.3\"/></bsdf>");
  EXPECT_EQ(blend.rd.value, Color(0.1F));
  EXPECT_EQ(blend.rs.value, Color(0.2F));
  EXPECT_EQ(blend.alpha.value, 0.3F);
}

TEST_F(SceneBsdfTest, RoughDielectric) {
  const auto plain = read_bsdf<bsdf::RoughDielectric>("<bsdf type=\"roughdielectric\"/>");
  EXPECT_EQ(plain.ka.value, Color(1));
  EXPECT_EQ(plain.alpha.value, 0.1F);
  EXPECT_EQ(plain.int_ior, 1.5046F);
  EXPECT_EQ(plain.ext_ior, 1.000277F);
  const auto frosted = read_bsdf<bsdf::RoughDielectric>(
      "<bsdf type=\"roughdielectric\"><color name=\"ka\" value=\"0.4\"/><float name=\"alpha\" "
      "value=\"0.3\"/>"
      "<float name=\"intIOR\" value=\"1.7\"/><float name=\"extIOR\" value=\"1.3\"/></bsdf>");
  EXPECT_EQ(frosted.ka.value, Color(0.4F));
  EXPECT_EQ(frosted.alpha.value, 0.3F);
  EXPECT_EQ(frosted.int_ior, 1.7F);
  EXPECT_EQ(frosted.ext_ior, 1.3F);
}

template <typename Type>
void expect_options(const Type& b, bsdf::Distribution distribution, Masking masking) {
  EXPECT_EQ(b.options.distribution, distribution);
  EXPECT_EQ(b.options.masking, masking);
}

TEST_F(SceneBsdfTest, RoughBsdfsKnowDistributionsAndMasking) {
  const auto bsdf = [](const std::string& type, const std::string& content) {
    return "<bsdf type=\"" + type + "\">" + content + "</bsdf>";
  };
  const auto check = [&]<typename Type>(const std::string& type) {
    using bsdf::Distribution;
    expect_options(read_bsdf<Type>(bsdf(type, "")), Distribution::beckmann, Masking::rational);
    const char* options =
        "<string name=\"distribution\" value=\"ggx\"/><string name=\"masking\" value=\"exact\"/>";
    expect_options(read_bsdf<Type>(bsdf(type, options)), Distribution::ggx, Masking::exact);
  };
  check.operator()<bsdf::RoughConductor>("roughconductor");
  check.operator()<bsdf::RoughSubstrate>("roughsubstrate");
  check.operator()<bsdf::RoughDielectric>("roughdielectric");
  check.operator()<bsdf::Microfacet>("microfacet");
  check.operator()<bsdf::FresnelBlend>("fresnelblend");
  const char* metal =
      "<bsdf type=\"roughconductor\"><boolean name=\"multiscatter\" value=\"true\"/></bsdf>";
  EXPECT_TRUE(read_bsdf<bsdf::RoughConductor>(metal).multiscatter);
  EXPECT_FALSE(read_bsdf<bsdf::RoughConductor>("<bsdf type=\"roughconductor\"/>").multiscatter);
}

}  // namespace

}  // namespace facet
