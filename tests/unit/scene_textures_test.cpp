// Textures in scene files: where they may stand, what they say, and what is wrong with them.
#include <gtest/gtest.h>

#include <limits>

#include "image/files.h"
#include "scene/reader.h"
#include "support/input.h"

namespace facet {

namespace {

class SceneTexturesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    Image image(2, 1, {"R", "G", "B"});
    image.at(0, 0, 0) = 1;
    image.at(1, 0, 2) = 0.5F;
    write_png(folder_.file("map.png"), image, 0);
  }

  /// The mesh's children begin on line 3.
  Scene read(const std::string& children) {
    return read_scene(folder_.write("scene.xml",
                                    "<scene><camera type=\"perspective\"/><mesh type=\"obj\">\n"
                                    "<string name=\"filename\" value=\"triangle.obj\"/>\n" +
                                        children + "</mesh></scene>"),
                      diagnostics_);
  }
  Scene read_bsdf(const std::string& type, const std::string& children) {
    return read("<bsdf type=\"" + type + "\">\n" + children + "</bsdf>");
  }
  template <typename Type>
  Type read_texture(const std::string& type, const std::string& properties) {
    const Scene scene = read_bsdf("diffuse", texture("albedo", type, properties));
    EXPECT_EQ(std::get<bsdf::Diffuse>(scene.bsdfs.at(0)).albedo.texture, 0U);
    return std::get<Type>(scene.textures.at(0));
  }
  static std::string texture(const std::string& name, const std::string& type = "checker",
                             const std::string& properties = "") {
    return "<texture type=\"" + type + "\" name=\"" + name + "\">" + properties + "</texture>\n";
  }
  static std::string file(const std::string& name) {
    return "<string name=\"filename\" value=\"" + name + "\"/>";
  }
  void expect_error(const std::string& children, int line,
                    std::initializer_list<const char*> words) {
    const std::string message = test::input_error_of([&] { return read(children); });
    test::expect_message(message, test::place(folder_.file("scene.xml"), line), words);
  }
  /// The bsdf's children begin on line 4.
  void expect_bsdf_error(const std::string& type, const std::string& children, int line,
                         std::initializer_list<const char*> words) {
    expect_error("<bsdf type=\"" + type + "\">\n" + children + "</bsdf>", line, words);
  }
  void TearDown() override {
    EXPECT_TRUE(diagnostics_.warnings().empty()) << diagnostics_.warnings()[0];
  }

  test::TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

TEST_F(SceneTexturesTest, EveryTexturedParameterTakesOne) {
  const Scene diffuse = read_bsdf("diffuse", texture("albedo"));
  EXPECT_TRUE(std::get<bsdf::Diffuse>(diffuse.bsdfs.at(0)).albedo.is_textured());

  const Scene metal = read_bsdf("roughconductor", texture("alpha") + texture("R0"));
  const auto& conductor = std::get<bsdf::RoughConductor>(metal.bsdfs.at(0));
  EXPECT_TRUE(conductor.r0.is_textured() && conductor.alpha.is_textured());
  EXPECT_NE(conductor.r0.texture, conductor.alpha.texture);
  EXPECT_EQ(metal.textures.size(), 2U);

  const Scene paint = read_bsdf("roughsubstrate", texture("kd") + texture("alpha"));
  const auto& substrate = std::get<bsdf::RoughSubstrate>(paint.bsdfs.at(0));
  EXPECT_TRUE(substrate.kd.is_textured() && substrate.alpha.is_textured());

  const Scene gloss = read_bsdf("fresnelblend", texture("Rd") + texture("Rs") + texture("alpha"));
  const auto& blend = std::get<bsdf::FresnelBlend>(gloss.bsdfs.at(0));
  EXPECT_TRUE(blend.rd.is_textured() && blend.rs.is_textured() && blend.alpha.is_textured());

  for (const char* name : {"ka", "m_ka"}) {
    const Scene glass = read_bsdf("roughdielectric", texture(name) + texture("alpha"));
    const auto& dielectric = std::get<bsdf::RoughDielectric>(glass.bsdfs.at(0));
    EXPECT_TRUE(dielectric.ka.is_textured() && dielectric.alpha.is_textured()) << name;
  }
}

TEST_F(SceneTexturesTest, WhatHasNoTextureKeepsItsValue) {
  const Scene scene =
      read_bsdf("roughconductor", texture("R0") + "<float name=\"alpha\" value=\"0.3\"/>");
  const auto& conductor = std::get<bsdf::RoughConductor>(scene.bsdfs.at(0));
  EXPECT_FALSE(conductor.alpha.is_textured());
  EXPECT_EQ(conductor.alpha.value, 0.3F);
}

TEST_F(SceneTexturesTest, AreaEmitters) {
  const Scene scene =
      read("<emitter type=\"area\"><float name=\"scale\" value=\"10\"/>" +
           texture("radiance", "checker", "<color name=\"color1\" value=\"7\"/>") + "</emitter>");
  const auto& area = std::get<AreaEmitter>(scene.emitters.at(0));
  EXPECT_EQ(area.emitted().texture, 0U);
  EXPECT_EQ(area.emitted().value, Color(10));
  EXPECT_NEAR(scene.mean_radiance(area).g, 10 * (7 + 0.1F) / 2, 1e-4F);
}

TEST_F(SceneTexturesTest, Checker) {
  const auto plain = read_texture<CheckerTexture>("checker", "");
  EXPECT_EQ(plain.even(), Color(0.9F));
  EXPECT_EQ(plain.odd(), Color(0.1F));
  EXPECT_EQ(plain.scale_x, 1);
  EXPECT_EQ(plain.scale_y, 1);
  const char* scales =
      "<integer name=\"scalex\" value=\"8\"/><integer name=\"scaley\" value=\"4\"/>";
  const auto scaled = read_texture<CheckerTexture>("checker", scales);
  EXPECT_EQ(scaled.scale_x, 8);
  EXPECT_EQ(scaled.scale_y, 4);
  const std::string color = "<color name=\"color\" value=\"0.3 0.4 0.5\"/>";
  const auto one = read_texture<CheckerTexture>("checker", color);
  EXPECT_EQ(one.even(), Color(0.3F, 0.4F, 0.5F));
  EXPECT_EQ(one.odd(), one.even());
  const auto two =
      read_texture<CheckerTexture>("checker", color + "<color name=\"color2\" value=\"0.2\"/>");
  EXPECT_EQ(two.even(), one.even());
  EXPECT_EQ(two.odd(), Color(0.2F));
  const auto first =
      read_texture<CheckerTexture>("checker", "<color name=\"color1\" value=\"0.2\"/>");
  EXPECT_EQ(first.even(), Color(0.2F));
  EXPECT_EQ(first.odd(), Color(0.1F));
}

TEST_F(SceneTexturesTest, Bitmap) {
  const auto plain = read_texture<BitmapTexture>("textmap", file("map.png"));
  EXPECT_EQ(plain.width, 2);
  EXPECT_EQ(plain.height, 1);
  EXPECT_EQ(plain.texels, (std::vector<std::uint32_t>{0x0000ffU, 0xbc0000U}))
      << "0.5 is 188 in sRGB";
  EXPECT_FALSE(plain.srgb);
  EXPECT_EQ(plain.factor, Color(1));
  EXPECT_EQ(plain.scale_x, 1);
  EXPECT_EQ(plain.scale_y, 1);
  const auto scaled = read_texture<BitmapTexture>(
      "textmap",
      file("map.png") +
          "<color name=\"color\" value=\"0.1 0.2 0.3\"/><float name=\"scalex\" value=\"2.5\"/>"
          "<integer name=\"scaley\" value=\"-3\"/><boolean name=\"srgb\" value=\"true\"/>");
  EXPECT_TRUE(scaled.srgb);
  EXPECT_EQ(scaled.factor, Color(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(scaled.scale_x, 2.5F);
  EXPECT_EQ(scaled.scale_y, -3);
}

TEST_F(SceneTexturesTest, MeansAndMaxima) {
  BitmapTexture map{2, 1, {0x0000ffU, 0xbc0000U}, false, Color(2, 1, 1), 1, 1};
  EXPECT_EQ(mean(map), Color(1, 0, 188.0F / 255 / 2));
  EXPECT_EQ(maximum(map), 2);
  map.srgb = true;
  EXPECT_NEAR(mean(map).b, 0.2514F, 5e-4F);
  EXPECT_EQ(mean(CheckerTexture{Color(1, 2, 3), Color(3, 2, 1)}), Color(2));
}

TEST_F(SceneTexturesTest, NamesThatAreNone) {
  expect_bsdf_error("diffuse", texture("albdo"), 4, {"\"albdo\"", "did you mean \"albedo\"?"});
  expect_bsdf_error("diffuse", "<texture type=\"checker\"/>", 4, {"no parameter \"\""});
  expect_bsdf_error("dielectric", texture("intIOR"), 4, {"\"intIOR\"", "cannot be a texture"});
  expect_bsdf_error("microfacet", "\n" + texture("kd"), 5, {"\"kd\"", "cannot be a texture"});
  expect_bsdf_error("mirror", texture("albedo"), 4, {"mirror", "cannot hold a <texture>"});
  expect_bsdf_error("roughconductor", texture("ka"), 4, {"no parameter \"ka\""});
  expect_bsdf_error("diffuse", texture("albedo", "chequer"), 4, {"did you mean \"checker\"?"});
  expect_bsdf_error("diffuse", texture("albedo", "checker", "\n" + texture("color")), 5,
                    {"cannot"});
}

TEST_F(SceneTexturesTest, TwoValuesForOneParameter) {
  const std::string color = "<color name=\"albedo\" value=\"1\"/>\n";
  expect_bsdf_error("diffuse", color + texture("albedo"), 5,
                    {"\"albedo\"", "as a property and as a texture"});
  expect_bsdf_error("diffuse", texture("albedo") + texture("albedo"), 5,
                    {"\"albedo\"", "given twice"});
  const std::string ka = "<color name=\"ka\" value=\"1\"/>\n";
  expect_bsdf_error("roughdielectric", texture("m_ka") + ka, 5,
                    {"\"ka\"", "\"m_ka\"", "another name"});
  expect_bsdf_error("roughdielectric", texture("ka") + texture("m_ka"), 3,
                    {"\"ka\"", "another name"});
  expect_bsdf_error("roughconductor", texture("alpha") + "<float name=\"alpha\" value=\"0.1\"/>", 4,
                    {"\"alpha\"", "as a property and as a texture"});
  expect_error("<emitter type=\"area\"><color name=\"radiance\" value=\"1\"/>\n" +
                   texture("radiance") + "</emitter>",
               4, {"\"radiance\"", "as a property and as a texture"});
}

TEST_F(SceneTexturesTest, AColourOfTheLabsTextureNameIsUnknown) {
  (void)read_bsdf("roughdielectric", "<color name=\"m_ka\" value=\"1\"/>");
  ASSERT_EQ(diagnostics_.warnings().size(), 1U);
  test::expect_message(diagnostics_.warnings()[0], test::place(folder_.file("scene.xml"), 4),
                       {"m_ka", "ignored"});
  diagnostics_ = Diagnostics(false);
}

TEST_F(SceneTexturesTest, ValuesOutOfRange) {
  const auto checker = [](const std::string& properties) {
    return texture("albedo", "checker", properties);
  };
  expect_bsdf_error("diffuse", checker("<color name=\"color1\" value=\"0 1.5 0\"/>"), 4,
                    {"checker", "1.5", "\"albedo\" lies between 0 and 1"});
  expect_bsdf_error("diffuse", checker("\n<color name=\"color\" value=\"-1\"/>"), 5, {"negative"});
  expect_bsdf_error("diffuse", checker("<integer name=\"scalex\" value=\"0\"/>"), 4,
                    {"\"scalex\"", "is 0"});
  expect_bsdf_error("diffuse", checker("<float name=\"scalex\" value=\"2\"/>"), 4,
                    {"must be a <integer>"});
  const auto map = [](const std::string& properties) {
    return texture("albedo", "textmap", file("map.png") + properties);
  };
  expect_bsdf_error("diffuse", map("<color name=\"color\" value=\"2\"/>"), 4,
                    {"textmap", "reaches 2"});
  expect_bsdf_error("diffuse", map("<float name=\"scaley\" value=\"1e30\"/>"), 4,
                    {"\"scaley\"", "1e+30"});
  expect_bsdf_error("diffuse", map("<boolean name=\"srgb\" value=\"yes\"/>"), 4,
                    {"\"srgb\"", "true or false"});
  expect_error("<emitter type=\"area\"><float name=\"scale\" value=\"1e20\"/>\n" +
                   texture("radiance", "checker", "<color name=\"color\" value=\"1e20\"/>") +
                   "</emitter>",
               4, {"checker", "1e+20", "\"radiance\""});
}

TEST_F(SceneTexturesTest, Files) {
  expect_bsdf_error("diffuse", texture("albedo", "textmap"), 4, {"\"filename\"", "missing"});
  expect_bsdf_error("diffuse", texture("albedo", "textmap", "\n" + file("none.png")), 5,
                    {"none.png"});
  expect_bsdf_error("diffuse", texture("albedo", "textmap", file("triangle.obj")), 4,
                    {"triangle.obj", "PNG"});
}

EnvironmentEmitter read_environment(const test::TemporaryFolder& folder, const Image& map,
                                    Diagnostics& diagnostics) {
  write_exr(folder.file("sky.exr"), map);
  const Scene scene = read_scene(
      folder.write(
          "scene.xml",
          "<scene><camera type=\"perspective\"/><emitter type=\"environment\"><string "
          "name=\"filename\" "
          "value=\"sky.exr\"/><string name=\"encoding\" value=\"linear\"/></emitter></scene>"),
      diagnostics);
  return std::get<EnvironmentEmitter>(scene.emitters.at(0));
}

TEST_F(SceneTexturesTest, EnvironmentsOfImpossibleTexelsAreMendedWithOneWarning) {
  Image map(2, 2, {"R", "G", "B"});
  map.at(0, 0, 0) = -1;
  map.at(1, 0, 1) = std::numeric_limits<float>::quiet_NaN();
  map.at(1, 1, 2) = std::numeric_limits<float>::infinity();
  map.at(0, 1, 2) = 7;
  Diagnostics diagnostics;
  const EnvironmentEmitter e = read_environment(folder_, map, diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_NE(diagnostics.warnings()[0].find("3 texels"), std::string::npos)
      << diagnostics.warnings()[0];
  EXPECT_EQ(e.texels[0], Color(0));
  EXPECT_EQ(e.texels[1], Color(0));
  EXPECT_EQ(e.texels[2], Color(0, 0, 7));
  EXPECT_EQ(e.texels[3], Color(0, 0, 1e30F));
}

TEST_F(SceneTexturesTest, EnvironmentsHaveChannelsOfManyNames) {
  for (const auto& [channels, red] :
       {std::pair(std::vector<std::string>{"b", "g", "r"}, 2),
        std::pair(std::vector<std::string>{"Y"}, 0),
        std::pair(std::vector<std::string>{"A", "ViewLayer.Combined.B", "ViewLayer.Combined.G",
                                           "ViewLayer.Combined.R"},
                  3)}) {
    Image map(1, 1, channels);
    map.at(0, 0, red) = 3;
    Diagnostics diagnostics;
    EXPECT_EQ(read_environment(folder_, map, diagnostics).texels[0].r, 3) << channels[0];
  }
}

TEST_F(SceneTexturesTest, AnEnvironmentsDisplayWindowIsTheSphere) {
  Image map(2, 1, {"R", "G", "B"});
  map.at(0, 0, 0) = 1;
  map.at(1, 0, 0) = 2;
  map.window = {1, 2, 4, 3};
  Diagnostics diagnostics;
  const EnvironmentEmitter e = read_environment(folder_, map, diagnostics);
  ASSERT_EQ(e.width, 4);
  ASSERT_EQ(e.height, 3);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(e.texels[i].r, i == 9 ? 1 : i == 10 ? 2 : 0) << i;
}

}  // namespace

}  // namespace facet
