// What must not change an image: pass sizes, geometry fetch, crops, the scene's scale.
#include <bit>
#include <cstring>

#include "support/render.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

/// A room with a light, a metal and a coated ball: every BSDF, both kinds of geometry, long paths.
Scene busy_scene() {
  Scene scene = make_scene("path_mis");
  add_mesh(scene, make_room(2), bsdf::Diffuse{Color(0.6F, 0.5F, 0.4F)});
  Mesh metal = make_sphere(3, false);
  transform(metal, 0.4F, {-0.4F, -0.6F, 0.2F});
  add_mesh(scene, metal, bsdf::RoughConductor{Color(0.9F, 0.8F, 0.5F), 0.2F});
  Mesh coated = make_sphere(3, false);
  transform(coated, 0.35F, {0.5F, -0.65F, -0.1F});
  add_mesh(scene, coated, bsdf::RoughSubstrate{Color(0.3F, 0.2F, 0.7F), 0.1F});
  add_mesh(scene,
           make_quad({-0.3F, 0.98F, -0.3F}, {0.3F, 0.98F, -0.3F}, {0.3F, 0.98F, 0.3F},
                     {-0.3F, 0.98F, 0.3F}),
           bsdf::Diffuse{}, Color(8));
  set_camera(scene, 40, 70, {0, 0, -0.95}, {0, -0.3, 0.5});
  scene.camera.filter = GaussianFilter{};
  return scene;
}

void expect_equal_bits(const Film& a, const Film& b) {
  ASSERT_FALSE(a.pixels.empty());
  EXPECT_TRUE(a.pixels == b.pixels);
}

TEST(Invariance, pass_size_changes_no_bit) {
  const Scene scene = busy_scene();
  const Rendered usual = render(scene, 9);
  for (const std::uint32_t slots : {64U, 1000U, 1600U, 5000U}) {
    RenderSettings settings = whole_image(scene, 9);
    settings.paths_in_flight = slots;
    expect_equal_bits(usual.film, render(scene, settings).film);
  }
}

TEST(Invariance, storage_buffers_change_no_bit) {
  const Scene scene = busy_scene();
  RenderSettings settings = whole_image(scene, 8);
  const Rendered texels = render(scene, settings);
  settings.force_storage_buffers = true;
  expect_equal_bits(texels.film, render(scene, settings).film);
}

TEST(Invariance, kernels_with_everything_in_change_no_bit) {
  std::vector<Scene> scenes{busy_scene()};
  for (const char* name :
       {"cbox/cbox_conductors_mis.xml", "serapis/serapis_rough_mis.xml", "whitted/whitted.xml"}) {
    scenes.push_back(load_scene(name));
    scenes.back().camera.width = 40;
    scenes.back().camera.height = 30;
  }
  for (const Scene& scene : scenes) {
    SCOPED_TRACE(scene.integrator.type.name);
    PackedScene packed = pack_scene(scene, whole_image(scene, 4));
    const Rendered own = render(packed);
    packed.features = packed.features.with_everything();
    const Rendered everything = render(packed);
    EXPECT_GT(everything.statistics.kernel_instructions, own.statistics.kernel_instructions);
    expect_equal_bits(own.film, everything.film);
  }
}

TEST(Invariance, crop_changes_no_bit) {
  const Scene scene = busy_scene();
  RenderSettings settings = whole_image(scene, 4);
  const Rendered whole = render(scene, settings);
  settings.crop = {7, 11, 29, 24};
  const Rendered part = render(scene, settings);
  for (int y = 11; y < 24; ++y) {
    for (int x = 7; x < 29; ++x) {
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(whole.image.at(x, y, c), part.image.at(x - 7, y - 11, c));
    }
  }
}

TEST(Invariance, random_numbers_depend_on_the_seed) {
  Scene scene = busy_scene();
  const Rendered a = render(scene, 4);
  scene.seed = 1;
  const Rendered b = render(scene, 4);
  int equal = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) equal += a.image.at(x, y, 0) == b.image.at(x, y, 0) ? 1 : 0;
  }
  EXPECT_LT(equal, 400);  // the light, seen directly, stays; little else does
}

/// The share of pixels that differ by more than 1 %; samples that take another branch by rounding
/// make a few.
double share_of_different_pixels(const Image& a, const Image& b) {
  int different = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      bool differs = false;
      for (int c = 0; c < 3; ++c)
        differs = differs ||
                  std::abs(a.at(x, y, c) - b.at(x, y, c)) > 0.01F * std::abs(a.at(x, y, c)) + 1e-6F;
      different += differs ? 1 : 0;
    }
  }
  return different / static_cast<double>(a.width() * a.height());
}

TEST(Invariance, scale_of_the_scene_does_not_matter) {
  const Rendered usual = render(busy_scene(), 16);
  for (const float scale : {1e-6F, 1e-4F, 1e4F, 1e6F}) {
    Scene scene = busy_scene();
    for (Mesh& mesh : scene.meshes) transform(mesh, scale, vec3(0));
    scene.camera.to_world[3] *= glm::dvec4(scale, scale, scale, 1);
    EXPECT_LT(share_of_different_pixels(usual.image, render(scene, 16).image), 0.02) << scale;
  }
}

}  // namespace
}  // namespace facet::test
