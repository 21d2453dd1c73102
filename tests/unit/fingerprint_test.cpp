// A scene's fingerprint changes with whatever matters to its image, and with nothing else.
#include "scene/fingerprint.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "support/scenes.h"

namespace facet::test {

namespace {

Scene make_varied_scene() {
  Scene scene = make_scene("path_mis");
  Mesh quad = make_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  quad.normals = {{0, 0, 1}, {0, 1, 0}};
  quad.texcoords = {{0, 0}, {0.5F, 1}};
  quad.normal_indices = {{0, 0, 1}, {0, 1, 0}};
  quad.texcoord_indices = {{0, 1, 0}, {1, 1, 0}};
  add_mesh(scene, quad, bsdf::Diffuse{Color(0.5F)});
  add_mesh(scene, quad, bsdf::RoughConductor{Color(0.9F), 0.2F});
  add_mesh(scene, quad, bsdf::RoughSubstrate{}, Color(3));
  scene.emitters.emplace_back(EnvironmentEmitter{2, 1, {Color(1), Color(2)}});
  add_mesh(scene, quad, bsdf::FresnelBlend{});
  scene.emitters.emplace_back(PointLight{{1, 2, 3}, Color(4)});
  scene.textures = {CheckerTexture{}, BitmapTexture{2, 1, {1, 2}}};
  std::get<bsdf::RoughConductor>(scene.bsdfs[1]).r0.texture = 1;
  scene.camera.filter = MitchellFilter{};
  return scene;
}

bsdf::FresnelBlend& blend(Scene& s) { return std::get<bsdf::FresnelBlend>(s.bsdfs[3]); }
BitmapTexture& bitmap(Scene& s) { return std::get<BitmapTexture>(s.textures[1]); }

using Change = std::function<void(Scene&)>;

const std::map<std::string, Change>& changes_that_matter() {
  static const std::map<std::string, Change> changes{
      {"position", [](Scene& s) { s.meshes[1].positions[2].y += 0x1p-23F; }},
      {"one position more", [](Scene& s) { s.meshes[1].positions.emplace_back(0, 0, 0); }},
      {"normal", [](Scene& s) { s.meshes[0].normals[1].x = 0.1F; }},
      {"texture coordinate", [](Scene& s) { s.meshes[0].texcoords[1].y = 0.9F; }},
      {"position index",
       [](Scene& s) {
         std::swap(s.meshes[0].position_indices[0].x, s.meshes[0].position_indices[0].y);
       }},
      {"order of triangles",
       [](Scene& s) {
         std::swap(s.meshes[0].position_indices[0], s.meshes[0].position_indices[1]);
       }},
      {"normal index", [](Scene& s) { s.meshes[0].normal_indices[0].x = none; }},
      {"no normals", [](Scene& s) { s.meshes[0].normal_indices.clear(); }},
      {"texture coordinate index", [](Scene& s) { s.meshes[0].texcoord_indices[1].z = 1; }},
      {"bsdf of a mesh", [](Scene& s) { s.meshes[0].bsdf = 1; }},
      {"emitter of a mesh", [](Scene& s) { s.meshes[0].emitter = 0; }},
      {"order of meshes", [](Scene& s) { std::swap(s.meshes[0], s.meshes[1]); }},
      {"one mesh less", [](Scene& s) { s.meshes.pop_back(); }},
      {"albedo", [](Scene& s) { std::get<bsdf::Diffuse>(s.bsdfs[0]).albedo.value.b = 0.4F; }},
      {"conductor's r0",
       [](Scene& s) { std::get<bsdf::RoughConductor>(s.bsdfs[1]).r0.value.g = 0.4F; }},
      {"conductor's alpha",
       [](Scene& s) { std::get<bsdf::RoughConductor>(s.bsdfs[1]).alpha = 0.3F; }},
      {"substrate's kd",
       [](Scene& s) { std::get<bsdf::RoughSubstrate>(s.bsdfs[2]).kd.value.r = 0.4F; }},
      {"substrate's alpha",
       [](Scene& s) { std::get<bsdf::RoughSubstrate>(s.bsdfs[2]).alpha = 0.3F; }},
      {"outer index", [](Scene& s) { std::get<bsdf::RoughSubstrate>(s.bsdfs[2]).ext_ior = 1.1F; }},
      {"inner index", [](Scene& s) { std::get<bsdf::RoughSubstrate>(s.bsdfs[2]).int_ior = 1.6F; }},
      {"blend's rd", [](Scene& s) { blend(s).rd.value.b = 0.4F; }},
      {"blend's rs", [](Scene& s) { blend(s).rs.value.b = 0.4F; }},
      {"texture of rd", [](Scene& s) { blend(s).rd.texture = 0; }},
      {"texture of rs", [](Scene& s) { blend(s).rs.texture = 0; }},
      {"texture of alpha", [](Scene& s) { blend(s).alpha.texture = 0; }},
      {"another texture",
       [](Scene& s) { std::get<bsdf::RoughConductor>(s.bsdfs[1]).r0.texture = 0; }},
      {"distribution", [](Scene& s) { blend(s).options.distribution = bsdf::Distribution::ggx; }},
      {"masking", [](Scene& s) { blend(s).options.masking = Masking::exact; }},
      {"multiscatter",
       [](Scene& s) { std::get<bsdf::RoughConductor>(s.bsdfs[1]).multiscatter = true; }},
      {"type of bsdf", [](Scene& s) { s.bsdfs[1] = bsdf::Diffuse{Color(0.9F)}; }},
      {"emitter's mesh", [](Scene& s) { std::get<AreaEmitter>(s.emitters[0]).mesh = 1; }},
      {"radiance", [](Scene& s) { std::get<AreaEmitter>(s.emitters[0]).radiance.value.r = 4; }},
      {"scale of the radiance", [](Scene& s) { std::get<AreaEmitter>(s.emitters[0]).scale = 2; }},
      {"texture of the radiance",
       [](Scene& s) { std::get<AreaEmitter>(s.emitters[0]).radiance.texture = 0; }},
      {"place of a light", [](Scene& s) { std::get<PointLight>(s.emitters[2]).position.y = 0; }},
      {"intensity", [](Scene& s) { std::get<PointLight>(s.emitters[2]).intensity.b = 0; }},
      {"checker's first",
       [](Scene& s) { std::get<CheckerTexture>(s.textures[0]).first = Color(0); }},
      {"checker's second",
       [](Scene& s) { std::get<CheckerTexture>(s.textures[0]).second = Color(0); }},
      {"checker's both",
       [](Scene& s) { std::get<CheckerTexture>(s.textures[0]).both = Color(0.5F); }},
      {"bitmap's colours",
       [](Scene& s) {
         bitmap(s).colors = {Color(1), Color(2)};
       }},
      {"checker's cells", [](Scene& s) { std::get<CheckerTexture>(s.textures[0]).scale_x = 2; }},
      {"checker's rows", [](Scene& s) { std::get<CheckerTexture>(s.textures[0]).scale_y = 2; }},
      {"texel of a texture", [](Scene& s) { bitmap(s).texels[1] = 3; }},
      {"shape of a texture", [](Scene& s) { std::swap(bitmap(s).width, bitmap(s).height); }},
      {"decoding", [](Scene& s) { bitmap(s).srgb = true; }},
      {"factor on a texture", [](Scene& s) { bitmap(s).factor.g = 0.5F; }},
      {"images along u", [](Scene& s) { bitmap(s).scale_x = 2; }},
      {"images along v", [](Scene& s) { bitmap(s).scale_y = 2; }},
      {"one texture more", [](Scene& s) { s.textures.emplace_back(CheckerTexture{}); }},
      {"texel", [](Scene& s) { std::get<EnvironmentEmitter>(s.emitters[1]).texels[1].g = 3; }},
      {"shape of the environment",
       [](Scene& s) {
         s.emitters[1] = EnvironmentEmitter{1, 2, {Color(1), Color(2)}};
       }},
      {"no environment", [](Scene& s) { s.emitters.erase(s.emitters.begin() + 1); }},
      {"no point light", [](Scene& s) { s.emitters.pop_back(); }},
      {"camera's place", [](Scene& s) { s.camera.to_world[3][0] += 1e-9; }},
      {"camera's axis", [](Scene& s) { s.camera.to_world[0][2] = 0.1; }},
      {"field of view", [](Scene& s) { s.camera.fov = 31; }},
      {"near clip", [](Scene& s) { s.camera.near_clip = 1e-3; }},
      {"far clip", [](Scene& s) { s.camera.far_clip = 1e3; }},
      {"type of filter", [](Scene& s) { s.camera.filter = GaussianFilter{}; }},
      {"tent", [](Scene& s) { s.camera.filter = TentFilter{}; }},
      {"box", [](Scene& s) { s.camera.filter = BoxFilter{}; }},
      {"gaussian of another width",
       [](Scene& s) {
         s.camera.filter = GaussianFilter{2, 0.6};
       }},
      {"gaussian of another radius",
       [](Scene& s) {
         s.camera.filter = GaussianFilter{3, 0.5};
       }},
      {"mitchell radius", [](Scene& s) { std::get<MitchellFilter>(s.camera.filter).radius = 3; }},
      {"mitchell B", [](Scene& s) { std::get<MitchellFilter>(s.camera.filter).b = 0.25; }},
      {"mitchell C", [](Scene& s) { std::get<MitchellFilter>(s.camera.filter).c = 0.25; }},
      {"place of the simple light", [](Scene& s) { s.integrator.position.x = 1; }},
      {"its energy", [](Scene& s) { s.integrator.energy.x = 2; }},
  };
  return changes;
}

TEST(Fingerprint, ChangesWithWhateverMatters) {
  std::map<std::uint64_t, std::string> seen{{fingerprint(make_varied_scene()), "unchanged"}};
  for (const auto& [name, change] : changes_that_matter()) {
    Scene scene = make_varied_scene();
    change(scene);
    const auto [place, is_new] = seen.emplace(fingerprint(scene), name);
    EXPECT_TRUE(is_new) << name << " is like " << place->second;
  }
}

TEST(Fingerprint, IsBlindToNamesAndToWhatTheRecordTells) {
  const std::map<std::string, Change> changes{
      {"file", [](Scene& s) { s.file = "/elsewhere/other.xml"; }},
      {"name of a mesh", [](Scene& s) { s.meshes[0].name = "other.obj"; }},
      {"line of a mesh",
       [](Scene& s) {
         s.meshes[0].where = {"other.xml", 7};
       }},
      {"samples", [](Scene& s) { s.sample_count = 77; }},
      {"seed", [](Scene& s) { s.seed = 77; }},
      {"width", [](Scene& s) { s.camera.width += 1; }},
      {"height", [](Scene& s) { s.camera.height += 1; }},
      {"integrator",
       [](Scene& s) { s.integrator.type = find_integrator_type("path_mats").value(); }},
      {"depth", [](Scene& s) { s.integrator.max_depth = 3; }},
      {"heuristic", [](Scene& s) { s.integrator.heuristic = Heuristic::power; }},
      {"sampler", [](Scene& s) { s.sampler = Sampler::sobol; }},
      {"file of a texture", [](Scene& s) { bitmap(s).filename = "other.png"; }},
      {"memory", [](Scene& s) { s.meshes[0].positions.reserve(1000); }},
  };
  for (const auto& [name, change] : changes) {
    Scene scene = make_varied_scene();
    change(scene);
    EXPECT_EQ(fingerprint(scene), fingerprint(make_varied_scene())) << name;
  }
}

TEST(Fingerprint, IsTheSameOnEveryMachine) {
  // Whoever changes the hash changes this number, and parts rendered before no longer join those
  // after.
  EXPECT_EQ(fingerprint(make_varied_scene()), 0xc1c0cd2ef441fa25U);
}

}  // namespace

}  // namespace facet::test
