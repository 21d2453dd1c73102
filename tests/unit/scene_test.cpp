// What the scene reader makes of valid files: defaults, overrides, extensions.
#include <gtest/gtest.h>

#include "image/files.h"
#include "scene/reader.h"
#include "support/input.h"

namespace facet {

namespace {

/// A folder with a triangle; scenes have a camera unless they bring one.
class SceneTest : public ::testing::Test {
 protected:
  void SetUp() override { folder_.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"); }

  Scene read(const std::string& text) {
    return read_scene(folder_.write("scene.xml", text), diagnostics_);
  }
  Scene read_body(const std::string& body) {
    return read("<scene>\n<camera type=\"perspective\"/>\n" + body + "\n</scene>\n");
  }
  Camera read_camera(const std::string& properties) {
    return read("<scene><camera type=\"perspective\">" + properties + "</camera></scene>").camera;
  }
  Filter read_filter(const std::string& filter) { return read_camera(filter).filter; }
  Scene read_mesh(const std::string& children) {
    const std::string file = "<string name=\"filename\" value=\"triangle.obj\"/>";
    return read_body("<mesh type=\"obj\">" + file + children + "</mesh>");
  }
  EnvironmentEmitter read_environment(const std::string& properties) {
    const Scene scene = read_body("<emitter type=\"environment\">" + properties + "</emitter>");
    return std::get<EnvironmentEmitter>(scene.emitters.at(0));
  }
  void TearDown() override {
    EXPECT_TRUE(diagnostics_.warnings().empty()) << diagnostics_.warnings()[0];
  }

  test::TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

TEST_F(SceneTest, CameraDefaults) {
  const Camera c = read_camera("");
  EXPECT_EQ(c.width, 1280);
  EXPECT_EQ(c.height, 720);
  EXPECT_EQ(c.fov, 30);
  EXPECT_EQ(c.near_clip, 1e-4);
  EXPECT_EQ(c.far_clip, 1e4);
  EXPECT_EQ(c.to_world, dmat4(1));
  const auto filter = std::get<GaussianFilter>(c.filter);
  EXPECT_EQ(filter.radius, 2);
  EXPECT_EQ(filter.stddev, 0.5);
}

TEST_F(SceneTest, CameraProperties) {
  const Camera c = read_camera(
      "<integer name=\"width\" value=\"7\"/><integer name=\"height\" value=\"5\"/><float "
      "name=\"fov\" "
      "value=\"45.5\"/>"
      "<float name=\"nearClip\" value=\"0.5\"/><float name=\"farClip\" value=\"1e6\"/>"
      "<transform name=\"toWorld\"><scale value=\"-1 1 1\"/><translate value=\"1 2 "
      "3\"/></transform>");
  EXPECT_EQ(c.width, 7);
  EXPECT_EQ(c.height, 5);
  EXPECT_EQ(c.fov, 45.5);
  EXPECT_EQ(c.near_clip, 0.5);
  EXPECT_EQ(c.far_clip, 1e6);
  EXPECT_EQ(c.to_world * glm::dvec4(1, 1, 1, 1), glm::dvec4(0, 3, 4, 1));
}

TEST_F(SceneTest, Filters) {
  const auto gaussian = std::get<GaussianFilter>(
      read_filter("<rfilter type=\"gaussian\"><float name=\"radius\" "
                  "value=\"3\"/><float name=\"stddev\" value=\"0.7\"/></rfilter>"));
  EXPECT_EQ(gaussian.radius, 3);
  EXPECT_EQ(gaussian.stddev, 0.7);
  const auto plain = std::get<MitchellFilter>(read_filter("<rfilter type=\"mitchell\"/>"));
  EXPECT_EQ(plain.radius, 2);
  EXPECT_DOUBLE_EQ(plain.b, 1.0 / 3);
  EXPECT_DOUBLE_EQ(plain.c, 1.0 / 3);
  const auto mitchell = std::get<MitchellFilter>(
      read_filter("<rfilter type=\"mitchell\"><float name=\"B\" value=\"0\"/><float "
                  "name=\"C\" value=\"0.5\"/></rfilter>"));
  EXPECT_EQ(mitchell.b, 0);
  EXPECT_EQ(mitchell.c, 0.5);
  EXPECT_TRUE(std::holds_alternative<TentFilter>(read_filter("<rfilter type=\"tent\"/>")));
  EXPECT_TRUE(std::holds_alternative<BoxFilter>(read_filter("<rfilter type=\"box\"/>")));
}

TEST_F(SceneTest, SamplerDefaultsAndProperties) {
  EXPECT_EQ(read_body("").sample_count, 1);
  const Scene plain = read_body("<sampler type=\"independent\"/>");
  EXPECT_EQ(plain.sample_count, 1);
  EXPECT_EQ(plain.seed, 0U);
  EXPECT_EQ(plain.sampler, Sampler::independent);
  EXPECT_EQ(read_body("<sampler type=\"sobol\"/>").sampler, Sampler::sobol);
  const Scene scene = read_body(
      "<sampler type=\"independent\"><integer name=\"sampleCount\" value=\"33\"/><integer "
      "name=\"seed\" "
      "value=\"9\"/>"
      "</sampler>");
  EXPECT_EQ(scene.sample_count, 33);
  EXPECT_EQ(scene.seed, 9U);
}

TEST_F(SceneTest, EveryIntegratorIsReadByItsName) {
  for (const IntegratorType& type : integrator_types()) {
    const Scene scene = read_body("<integrator type=\"" + std::string(type.name) + "\"/>");
    EXPECT_EQ(scene.integrator.type.name, type.name);
    EXPECT_EQ(scene.integrator.max_depth, -1);
    EXPECT_EQ(scene.integrator.heuristic, Heuristic::balance);
  }
  EXPECT_TRUE(read_body("").integrator.type.name.empty());
}

TEST_F(SceneTest, IntegratorExtensions) {
  const Scene scene = read_body(
      "<integrator type=\"path_mis\"><integer name=\"maxDepth\" value=\"4\"/>"
      "<string name=\"heuristic\" value=\"power\"/></integrator>");
  EXPECT_EQ(scene.integrator.interaction_limit(), 4);
  EXPECT_EQ(scene.integrator.heuristic, Heuristic::power);
  const Scene direct = read_body(
      "<integrator type=\"direct_mis\"><integer name=\"maxDepth\" value=\"4\"/></integrator>");
  EXPECT_EQ(direct.integrator.interaction_limit(), 1);
}

TEST_F(SceneTest, MeshDefaults) {
  const Scene scene = read_mesh("");
  ASSERT_EQ(scene.meshes.size(), 1U);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.emitter, none);
  EXPECT_EQ(mesh.where.line, 3);
  EXPECT_EQ(scene.triangle_count(), 1U);
  EXPECT_EQ(std::get<bsdf::Diffuse>(scene.bsdfs.at(mesh.bsdf)).albedo.value, Color(0.5F));
  EXPECT_TRUE(scene.emitters.empty());
}

TEST_F(SceneTest, EveryMeshHasItsOwnPartners) {
  const std::string file = "<string name=\"filename\" value=\"triangle.obj\"/>";
  const std::string light = "<emitter type=\"area\"/>";
  const Scene scene = read_body("<mesh type=\"obj\">" + file +
                                "</mesh><emitter type=\"environment\"/><mesh type=\"obj\">" +
                                light + file + "<bsdf type=\"roughconductor\"/></mesh>");
  ASSERT_EQ(scene.meshes.size(), 2U);
  ASSERT_EQ(scene.emitters.size(), 2U);
  EXPECT_EQ(scene.meshes[0].emitter, none);
  const auto& area = std::get<AreaEmitter>(scene.emitters.at(scene.meshes[1].emitter));
  EXPECT_EQ(area.mesh, 1U);
  EXPECT_TRUE(std::holds_alternative<bsdf::RoughConductor>(scene.bsdfs.at(scene.meshes[1].bsdf)));
  EXPECT_TRUE(std::holds_alternative<EnvironmentEmitter>(scene.emitters.at(scene.environment())));
}

TEST_F(SceneTest, MeshesArePlacedInTheWorld) {
  const Scene scene = read_mesh(
      "<transform name=\"toWorld\"><scale value=\"2\"/><translate value=\"0 0 5\"/></transform>");
  EXPECT_EQ(scene.meshes[0].positions[1], vec3(2, 0, 5));
  EXPECT_EQ(scene.bounds().upper, vec3(2, 2, 5));
}

TEST_F(SceneTest, MeshFilesMayLieInFolders) {
  std::filesystem::create_directory(folder_.file("meshes"));
  std::filesystem::copy(folder_.file("triangle.obj"), folder_.file("meshes/t.obj"));
  const char* body = "<mesh type=\"obj\"><string name=\"filename\" value=\"meshes/t.obj\"/></mesh>";
  EXPECT_EQ(read_body(body).triangle_count(), 1U);
}

TEST_F(SceneTest, AreaEmitter) {
  const auto emitted = [](const Scene& scene) {
    return std::get<AreaEmitter>(scene.emitters.at(0)).emitted().value;
  };
  EXPECT_EQ(emitted(read_mesh("<emitter type=\"area\"/>")), Color(1));
  const Scene scene = read_mesh(
      "<emitter type=\"area\"><color name=\"radiance\" value=\"1 2 3\"/><float name=\"scale\" "
      "value=\"10\"/></emitter>");
  EXPECT_EQ(emitted(scene), Color(10, 20, 30));
}

TEST_F(SceneTest, PointLight) {
  const auto plain =
      std::get<PointLight>(read_body("<emitter type=\"pointlight\"/>").emitters.at(0));
  EXPECT_EQ(plain.position, vec3(0, 100, 0));
  EXPECT_EQ(plain.intensity, Color(1));
  const Scene scene = read_body(
      "<emitter type=\"pointlight\"><point name=\"position\" value=\"1, 2, 3\"/><color "
      "name=\"radiance\" "
      "value=\"4 5 "
      "6\"/></emitter><emitter type=\"pointlight\"/>");
  ASSERT_EQ(scene.emitters.size(), 2U);
  const auto& light = std::get<PointLight>(scene.emitters[0]);
  EXPECT_EQ(light.position, vec3(1, 2, 3));
  EXPECT_EQ(light.intensity, Color(4, 5, 6));
}

TEST_F(SceneTest, SimpleHasALightOfItsOwn) {
  const Integrator plain = read_body("<integrator type=\"simple\"/>").integrator;
  EXPECT_EQ(plain.position, vec3(0));
  EXPECT_EQ(plain.energy, Color(1));
  const Integrator simple =
      read_body(
          "<integrator type=\"simple\"><point name=\"position\" value=\"1 2 3\"/><color "
          "name=\"energy\" value=\"4e3 5 6\"/></integrator>")
          .integrator;
  EXPECT_EQ(simple.position, vec3(1, 2, 3));
  EXPECT_EQ(simple.energy, Color(4000, 5, 6));
  EXPECT_TRUE(read_body("<integrator type=\"whitted\"/>").integrator.type.every_emitter);
  EXPECT_FALSE(read_body("<integrator type=\"path_mis\"/>").integrator.type.every_emitter);
}

TEST_F(SceneTest, ConstantEnvironment) {
  const EnvironmentEmitter plain = read_environment("");
  EXPECT_EQ(plain.width, 1);
  EXPECT_EQ(plain.height, 1);
  EXPECT_EQ(plain.texels.at(0), Color(1)) << "without a map nothing is divided by 255";
  EXPECT_EQ(read_environment("<color name=\"radiance\" value=\"1 2 3\"/>").texels.at(0),
            Color(1, 2, 3));
}

TEST_F(SceneTest, MappedEnvironmentIsDividedBy255UnlessLinear) {
  Image map(2, 3, {"R", "G", "B"});
  map.at(1, 2, 0) = 51;
  map.at(1, 2, 1) = 102;
  write_exr(folder_.file("sky.exr"), map);
  const std::string file =
      "<string name=\"filename\" value=\"sky.exr\"/><color name=\"radiance\" value=\"10\"/>";
  const EnvironmentEmitter msa = read_environment(file);
  EXPECT_EQ(msa.width, 2);
  EXPECT_EQ(msa.height, 3);
  EXPECT_FLOAT_EQ(msa.texels.at(5).r, 2);
  EXPECT_FLOAT_EQ(msa.texels.at(5).g, 4);
  EXPECT_EQ(msa.texels.at(0), Color(0)) << "rows stay as in the file";
  const EnvironmentEmitter linear =
      read_environment(file + "<string name=\"encoding\" value=\"linear\"/>");
  EXPECT_FLOAT_EQ(linear.texels.at(5).r, 510);
}

TEST_F(SceneTest, LuminanceMapsServeAllChannels) {
  Image map(1, 1, {"Y"});
  map.at(0, 0, 0) = 255;
  write_exr(folder_.file("grey.exr"), map);
  EXPECT_EQ(read_environment("<string name=\"filename\" value=\"grey.exr\"/>").texels.at(0),
            Color(1));
}

TEST_F(SceneTest, CommentsDeclarationsAndNamesOfObjectsChangeNothing) {
  const Scene scene = read(
      "<?xml version='1.0' encoding='utf-8'?>\r\n<!-- a comment -->\r\n<scene>\r\n<!-- <camera/> "
      "-->\r\n"
      "<camera type=\"perspective\" name=\"main\"/>\r\n</scene>\r\n");
  EXPECT_EQ(scene.camera.width, 1280);
}

}  // namespace

}  // namespace facet
