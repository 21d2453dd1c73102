// What `facet render` warns of.
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "image/files.h"
#include "support/images.h"

namespace facet::test {

namespace {

using RenderWarningsCliTest = CliTest;

TEST_F(RenderWarningsCliTest, WarnsWhereTheEstimatedErrorIsNotToBeTrusted) {
  folder_.write("light.obj", "v 0 3 0\nv 0.3 3 0\nv 0.3 3 0.3\nv 0 3 0.3\nf 1 2 3 4\n");
  const std::vector<std::string> options{"render", "scene.xml", "-o",     "a.exr",  "--spp",
                                         "64",     "--quiet",   "--json", "a.json", "--integrator"};
  const auto with = [&](const std::string& integrator) {
    auto words = options;
    words.push_back(integrator);
    return run(words);
  };
  expect_words(with("direct_mats").err,
               {"warning: the error is larger than its estimate", "fewer than 4 of"});
  const auto json = nlohmann::json::parse(folder_.read("a.json"));
  EXPECT_GT(json["heavy_tails"]["pixels"], 5);
  EXPECT_GT(json["heavy_tails"]["variance_share"], 0.9);
  EXPECT_EQ(json["heavy_tails"]["worst"][0].size(), 2U);
  EXPECT_EQ(with("direct_ems").err, "");
}

TEST_F(RenderWarningsCliTest, WarnsOfPixelsNarrowerThanDirectionsCanTell) {
  const auto warnings = [&](const std::string& origin, const std::string& fov) {
    folder_.write("narrow.xml", R"(<scene><integrator type="normals"/><camera type="perspective">
<integer name="width" value="16"/><integer name="height" value="16"/><float name="fov" value=")" +
                                    fov + R"("/><transform name="toWorld"><lookat origin=")" +
                                    origin +
                                    R"(" target="0 0 0" up="0 1 0"/></transform></camera>)" +
                                    floor() + "</scene>");
    return run({"render", "narrow.xml", "-o", "a.exr", "--quiet"}).err;
  };
  expect_words(warnings("3 2 1", "0.001"),
               {"narrow.xml: ", "fov 0.001", "0.05 pixels", "in double"});
  const Result in_double = run({"render", "narrow.xml", "-o", "a.exr", "--quiet", "--strict",
                                "--backend", "reference", "--precision", "double"});
  EXPECT_EQ(in_double.code, 0) << in_double.err;
  EXPECT_EQ(warnings("3 2 1", "0.003"), "");
  EXPECT_EQ(warnings("0 0 5", "0.001"), "");
}

TEST_F(RenderWarningsCliTest, WarnsOfScenesThatFloatsCannotHold) {
  const auto warnings = [&](const std::string& far) {
    folder_.write("huge.obj", "v 0 0 0\nv " + far + " 0 0\nv 0 " + far + " 0\nf 1 2 3\n");
    write_scene("huge.xml", mesh("huge.obj", "") + light());
    return run({"render", "huge.xml", "-o", "a.exr", "--quiet"}).err;
  };
  expect_words(warnings("1e30"), {"huge.xml", "1e+30", "in double"});
  EXPECT_EQ(warnings("1e17"), "");
}

TEST_F(RenderWarningsCliTest, WarnsOfLampsThatLieInAWall) {
  const auto warnings = [&](const std::string& meshes) {
    write_scene("lamps.xml", meshes);
    return run({"render", "lamps.xml", "-o", "a.exr", "--quiet"}).err;
  };
  folder_.write("ceiling.obj", "v -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\nf 1 2 3 4\n");
  folder_.write("turned.obj", "v -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\nf 1 4 3 2\n");
  folder_.write("higher.obj",
                "v -1 1.00001 -1\nv 1 1.00001 -1\nv 1 1.00001 1\nv -1 1.00001 1\nf 1 2 3 4\n");
  folder_.write("foot.obj", "v -0.5 0 -0.5\nv 0.5 0 -0.5\nv 0.5 0 0.5\nv -0.5 0 0.5\nf 1 2 3 4\n");
  const std::string wall = "<bsdf type=\"diffuse\"/>";
  const auto expect_warning = [](const std::string& text, const char* other) {
    expect_words(text, {"warning: ", "lamps.xml:", "light.obj and", other, "lie in one plane"});
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  };
  expect_warning(warnings(light() + mesh("ceiling.obj", wall)), "ceiling.obj");
  // A wall that shows its back hides the lamp as well.
  expect_warning(warnings(light() + mesh("turned.obj", wall)), "turned.obj");
  expect_warning(warnings(light() + light()), "light.obj");
  EXPECT_EQ(warnings(light() + mesh("higher.obj", wall)), "");
  // Two lamps back to back, the camera on one's bright side, in either order.
  folder_.write("back.obj", "v -0.5 1 -0.5\nv 0.5 1 -0.5\nv 0.5 1 0.5\nv -0.5 1 0.5\nf 4 3 2 1\n");
  const std::string back = mesh("back.obj", "<emitter type=\"area\"/>");
  expect_words(warnings(light() + back), {"lie in one plane"});
  expect_words(warnings(back + light()), {"lie in one plane"});
  // The underside of a lamp that stands on the floor is nobody's light.
  EXPECT_EQ(warnings(floor() + light() + mesh("foot.obj", "<emitter type=\"area\"/>")), "");
  write_scene("lamps.xml", light() + mesh("ceiling.obj", wall));
  expect_failure({"render", "lamps.xml", "-o", "a.exr", "--strict"}, 2,
                 {"lie in one plane", "--strict"});
}

TEST_F(RenderWarningsCliTest, AnEmptySceneIsBlackWithAWarning) {
  write_scene("empty.xml", "");
  const Result result = run({"render", "empty.xml", "--quiet"});
  EXPECT_EQ(result.code, 0);
  expect_words(result.err, {"warning: empty.xml: ", "no triangles", "no emitter"});
  EXPECT_EQ(largest(read_exr(folder_.file("empty.exr"))), 0);
}

TEST_F(RenderWarningsCliTest, ASceneWithoutEmitterIsBlackWithAWarning) {
  write_scene("dark.xml", floor());
  const Result result = run({"render", "dark.xml", "--quiet"});
  EXPECT_EQ(result.code, 0);
  expect_words(result.err, {"warning: dark.xml: ", "no emitter", "direct_mis", "black"});
  EXPECT_EQ(largest(read_exr(folder_.file("dark.exr"))), 0);
  EXPECT_EQ(run({"render", "dark.xml", "--quiet", "--strict"}).code, 2);
}

TEST_F(RenderWarningsCliTest, ASceneWithoutMeshShowsItsEnvironment) {
  write_scene("sky.xml",
              "<emitter type=\"environment\"><color name=\"radiance\" value=\"0.25\"/></emitter>");
  const Result result = run({"render", "sky.xml", "--quiet"});
  EXPECT_EQ(result.code, 0);
  expect_words(result.err, {"no triangles"});
  const Image image = read_exr(folder_.file("sky.exr"));
  for (int i = 0; i < 256; ++i) EXPECT_NEAR(image.at(i % 16, i / 16, 0), 0.25F, 1e-5F) << i;
}

}  // namespace

}  // namespace facet::test
