// Materials files: what they give to meshes without a <bsdf>, and what is said of it.
#include <gtest/gtest.h>

#include "image/files.h"
#include "scene/reader.h"
#include "support/input.h"
#include "support/obj.h"

namespace facet {

namespace {

using test::square;

class MtlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("mesh.obj",
                  "mtllib mesh.mtl\n" + square +
                      "vt 0 0\nusemtl red\nf 1/1 2/1 3/1\nusemtl mapped\nf 1/1 3/1 4/1\n");
    std::filesystem::create_directory(folder_.file("maps"));
    Image image(1, 1, {"R", "G", "B"});
    image.at(0, 0, 1) = 0.25F;
    write_png(folder_.file("maps/map.png"), image, 0);
  }
  Scene read(const std::string& materials, const std::string& children = "") {
    folder_.write("mesh.mtl", materials);
    return read_scene_with(children);
  }
  Scene read_scene_with(const std::string& children) {
    diagnostics_ = Diagnostics();
    return read_scene(
        folder_.write("scene.xml",
                      "<scene><camera type=\"perspective\"/>\n<mesh type=\"obj\"><string "
                      "name=\"filename\" value=\"mesh.obj\"/>" +
                          children + "</mesh></scene>"),
        diagnostics_);
  }
  static Color albedo(const Scene& scene, std::size_t mesh) {
    return std::get<bsdf::Diffuse>(scene.bsdfs.at(scene.meshes.at(mesh).bsdf)).albedo.value;
  }
  void expect_warnings(const std::vector<std::vector<const char*>>& expected) {
    ASSERT_EQ(diagnostics_.warnings().size(), expected.size())
        << fmt::format("{}", fmt::join(diagnostics_.warnings(), "\n"));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      for (const char* word : expected[i])
        EXPECT_NE(diagnostics_.warnings()[i].find(word), std::string::npos)
            << word << " in " << diagnostics_.warnings()[i];
    }
  }

  test::TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

TEST_F(MtlTest, ColoursAndTexturesMakeDiffuseMeshes) {
  for (const char* map : {"maps/map.png", "maps\\map.png", "-blendu on maps/map.png"}) {
    const Scene scene = read(
        fmt::format("# by hand\r\nnewmtl  red \r\nKd 0.8 .25 0\r\nKs 1 1 1\r\n\r\nnewmtl mapped\r\n"
                    "map_Kd {}\r\n",
                    map));
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_EQ(albedo(scene, 0), Color(0.8F, 0.25F, 0));
    const auto& mapped = std::get<bsdf::Diffuse>(scene.bsdfs.at(scene.meshes.at(1).bsdf));
    ASSERT_EQ(mapped.albedo.texture, 0U) << map;
    const auto& texture = std::get<BitmapTexture>(scene.textures.at(0));
    EXPECT_TRUE(texture.srgb);
    EXPECT_EQ(texture.scale_x, -1) << "u runs to the right";
    EXPECT_NEAR(texel(texture, 0).g, 0.25F, 0.005F);
    expect_warnings({{"scene.xml:2", "no <bsdf>", "mesh.mtl"}});
    // What is written must not take their place.
    const auto inputs = diagnostics_.inputs();
    const auto is_input = [&](const std::string& name) {
      return std::any_of(inputs.begin(), inputs.end(), [&](const auto& i) {
        return std::filesystem::exists(i) && std::filesystem::equivalent(i, folder_.file(name));
      });
    };
    EXPECT_TRUE(is_input("mesh.mtl"));
    EXPECT_TRUE(is_input("maps/map.png"));
  }
}

TEST_F(MtlTest, ABsdfCountsMore) {
  const Scene scene = read("newmtl red\nKd 1 0 0\n", "<bsdf type=\"mirror\"/>");
  EXPECT_EQ(scene.meshes.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<bsdf::Mirror>(scene.bsdfs.at(0)));
  expect_warnings({});
}

TEST_F(MtlTest, EveryPartShinesWhereTheMeshDoes) {
  const Scene scene =
      read("newmtl red\nKd 1 0 0\n",
           "<emitter type=\"area\"><color name=\"radiance\" value=\"3\"/></emitter>");
  ASSERT_EQ(scene.meshes.size(), 2U);
  ASSERT_EQ(scene.emitters.size(), 2U);
  for (std::uint32_t i = 0; i < 2; ++i) {
    EXPECT_EQ(scene.meshes[i].emitter, i);
    EXPECT_EQ(std::get<AreaEmitter>(scene.emitters[i]).mesh, i);
    EXPECT_EQ(std::get<AreaEmitter>(scene.emitters[i]).emitted().value, Color(3));
  }
}

TEST_F(MtlTest, WhatIsMissingDrawsAWarning) {
  std::filesystem::remove(folder_.file("mesh.mtl"));
  EXPECT_EQ(albedo(read_scene_with(""), 0), Color(0.5F));
  expect_warnings({{"materials are missing", "mesh.mtl", "no such file"}});
  EXPECT_EQ(albedo(read("version https://git-lfs.github.com/spec/v1\n"), 1), Color(0.5F));
  expect_warnings({{"materials are missing", "Git LFS"}});
  EXPECT_EQ(albedo(read("newmtl green\nKd 0 1 0\n"), 0), Color(0.5F));
  expect_warnings({{"no materials file defines \"red\" and 1 more"}, {"no <bsdf>"}});
  EXPECT_EQ(albedo(read("newmtl red\nnewmtl mapped\nKd 0 1 0\nmap_Kd none.png\n"), 1),
            Color(0, 1, 0));
  expect_warnings(
      {{"material \"mapped\"", "none.png", "no such file", "its colour stands in"}, {"no <bsdf>"}});
}

TEST_F(MtlTest, ColoursAreMovedIntoRange) {
  EXPECT_EQ(albedo(read("newmtl red\nKd 2 -1 0.5\nnewmtl mapped\nKd 0 0 0\n"), 0),
            Color(1, 0, 0.5F));
  expect_warnings({{"mesh.mtl", "\"red\"", "Kd", "2"}, {"mesh.mtl", "-1"}, {"no <bsdf>"}});
}

}  // namespace

}  // namespace facet
