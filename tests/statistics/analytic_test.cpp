// Materials and textures in scenes whose radiance is known.
#include "statistics/analytic.h"

#include <cmath>
#include <numbers>

namespace facet::test {
namespace {

bool follows_paths(const std::string& integrator) { return integrator.starts_with("path"); }

/// A body under an even sky of radiance 1, the camera seeing nothing but the body.
Scene furnace_with(Mesh mesh, const Bsdf& bsdf) {
  Scene scene = make_scene("path_mis");
  add_mesh(scene, std::move(mesh), bsdf);
  scene.emitters.emplace_back(EnvironmentEmitter{1, 1, {Color(1)}});
  set_camera(scene, 8, 8, {0.5, 1, -6}, {0, 0, 0});
  return scene;
}

/// What absorbs nothing shows the sky's radiance, by every integrator that follows all of its
/// light.
TEST(Furnace, bodies_that_absorb_nothing_vanish) {
  const Mesh ball = make_sphere(4, false);
  bsdf::RoughConductor metal{Color(1), 0.5F};
  metal.multiscatter = true;
  bsdf::RoughConductor ggx_metal{Color(1), 0.5F, {bsdf::Distribution::ggx}};
  ggx_metal.multiscatter = true;
  for (const std::string& integrator : all_estimators()) {
    expect_radiance(furnace_with(ball, bsdf::Diffuse{Color(1)}), integrator, 64, dvec3(1));
    expect_radiance(furnace_with(ball, bsdf::Mirror{}), integrator, 64, dvec3(1));
    // Light goes through both sides of the glass: only whole paths, or chains of delta lobes, see
    // it all.
    if (follows_paths(integrator) || integrator == "whitted")
      expect_radiance(furnace_with(ball, bsdf::Dielectric{1, 1.5F}), integrator, 4096, dvec3(1));
  }
  // The tables of albedos are interpolated: they are right to a thousandth, which a test of the
  // mean would see.
  bsdf::RoughConductor smoother = ggx_metal;
  smoother.alpha = 0.1F;
  for (const auto& conductor : {metal, ggx_metal, smoother}) {
    const Mean mean = mean_of(render(furnace_with(ball, conductor), 1024).image, 0);
    EXPECT_NEAR(mean.value, 1, 0.001 + 4 * mean.error);
  }
}

// Without the energy of multiple scattering a rough metal loses light, with it none: the option
// does something.
TEST(Furnace, rough_metal_loses_light_without_multiscatter) {
  const Mean mean = mean_of(
      render(furnace_with(make_sphere(4, false), bsdf::RoughConductor{Color(1), 0.8F}), 256).image,
      0);
  EXPECT_LT(mean.value, 0.9);
}

/// Fresnel's unpolarised reflectance from Snell's law and the amplitudes.
double fresnel(double cos_i, double n) {
  const double cos_t = std::sqrt(1 - (1 - cos_i * cos_i) / (n * n));
  const double rs = (cos_i - n * cos_t) / (cos_i + n * cos_t);
  const double rp = (n * cos_i - cos_t) / (n * cos_i + cos_t);
  return (rs * rs + rp * rp) / 2;
}

// One interface: what is refracted carries the radiance of the other side, compressed by
// (eta_o/eta_i)^2.
TEST(Dielectric, one_interface_scales_refracted_radiance) {
  Scene scene = make_scene("direct_mats");
  add_mesh(scene, make_quad({-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}),
           bsdf::Dielectric{1, 1.5F});
  scene.emitters.emplace_back(EnvironmentEmitter{1, 1, {Color(1)}});
  set_camera(scene, 4, 0.01, {-3, 4, 0}, {0, 0, 0});
  const double f = fresnel(0.8, 1.5);
  for (const std::string& integrator : all_estimators())
    expect_radiance(scene, integrator, 4096, dvec3(f + (1 - f) / (1.5 * 1.5)));
  set_camera(scene, 4, 0.01, {-3, -4, 0}, {0, 0, 0});
  const double from_below = fresnel(0.8, 1 / 1.5);
  for (const std::string& integrator : all_estimators())
    expect_radiance(scene, integrator, 4096, dvec3(from_below + (1 - from_below) * 1.5 * 1.5));
}

/// A plate of glass of index 1.5 and thickness 1 seen under 45 degrees, a strip of light behind it
/// where the ray arrives that is shifted by `shift`, and only there.
Scene slab(double shift) {
  Scene scene = make_scene("whitted");
  add_mesh(scene, make_quad({-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}),
           bsdf::Dielectric{1, 1.5F});
  add_mesh(scene, make_quad({-9, -1, -9}, {9, -1, -9}, {9, -1, 9}, {-9, -1, 9}),
           bsdf::Dielectric{1, 1.5F});
  // The unrefracted ray passes (0, 0, 0) and (2, -2, 0).
  const auto x = static_cast<float>(2 - shift);
  add_mesh(
      scene,
      make_quad({x - 0.05F, -2, -1}, {x - 0.05F, -2, 1}, {x + 0.05F, -2, 1}, {x + 0.05F, -2, -1}),
      bsdf::Diffuse{Color(0)}, Color(1));
  set_camera(scene, 4, 0.01, {-3, 3, 0}, {0, 0, 0});
  return scene;
}

// Snell: sin_t = sin 45/1.5; within the plate the ray advances by tan_t instead of 1.
TEST(Dielectric, a_slab_shifts_what_is_behind_it) {
  const double sin_t = std::sqrt(0.5) / 1.5;
  const double shift = 1 - sin_t / std::sqrt(1 - sin_t * sin_t);
  const double f = fresnel(std::sqrt(0.5), 1.5);
  for (const char* integrator : {"whitted", "path_mis", "path_mats", "path_ems"}) {
    expect_radiance(slab(shift), integrator, 4096, dvec3((1 - f) * (1 - f)));
    expect_radiance(slab(0), integrator, 256, dvec3(0));
  }
}

TEST(Simple, is_energy_over_four_pi_squared_by_cosine_and_distance) {
  Scene scene = make_scene("simple");
  add_mesh(scene, make_quad({-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}), bsdf::Mirror{});
  scene.integrator.position = {3, 4, 0};
  scene.integrator.energy = Color(100, 200, 300);
  set_camera(scene, 4, 0.001, {-3, 2, 0}, {0, 0, 0});
  const Image image = render(scene, 4).image;
  for (int c = 0; c < 3; ++c) {
    const double expected = 100.0 * (c + 1) / (4 * std::numbers::pi * std::numbers::pi) * 0.8 / 25;
    EXPECT_NEAR(mean_of(image, c).value / expected, 1, 1e-4);
  }
  // In the shadow of a blocker, and from behind, there is nothing.
  add_mesh(scene, make_quad({1, 2, -1}, {1, 2, 1}, {2, 2, 1}, {2, 2, -1}), bsdf::Diffuse{});
  EXPECT_EQ(mean_of(render(scene, 4).image, 0).value, 0);
  scene.meshes.pop_back();
  scene.integrator.position = {3, -4, 0};
  EXPECT_EQ(mean_of(render(scene, 4).image, 0).value, 0);
}

/// A square facing +z whose (u, v) run from (0, 0) to (1, 1), filling the camera's image exactly;
/// it emits its texture.
Scene textured_screen(const Texture& texture, int size) {
  Scene scene = make_scene("direct_mats");
  Mesh mesh = make_quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
  mesh.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.texcoord_indices = {{0, 1, 2}, {0, 2, 3}};
  scene.textures.push_back(texture);
  add_mesh(scene, mesh, bsdf::Diffuse{Color(0)}, Color(1));
  auto& emitter = std::get<AreaEmitter>(scene.emitters.front());
  emitter.radiance.texture = 0;
  emitter.scale = 2;
  set_camera(scene, size, 90, {0, 0, 1}, {0, 0, 0});
  return scene;
}

TEST(Textures, a_checker_seen_face_on_shows_its_cells) {
  CheckerTexture checker;
  checker.scale_x = 4;
  checker.scale_y = 2;
  const Image image = render(textured_screen(checker, 8), 16).image;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      // Row 0 is at the top, v = 1.
      const int cell = x / 2 + (7 - y) / 4;
      EXPECT_FLOAT_EQ(image.at(x, y, 0), cell % 2 == 0 ? 1.8F : 0.2F) << x << ',' << y;
    }
  }
}

TEST(Textures, an_image_is_seen_texel_by_texel_mirrored_in_u_as_in_nori) {
  BitmapTexture bitmap;
  bitmap.width = 2;
  bitmap.height = 2;
  bitmap.texels = {0x000000, 0x0000ff, 0x00ff00, 0xff0000};  // black, red / green, blue
  bitmap.factor = Color(0.5F);
  // A small camera looks at the place of each texel, where interpolation leaves it alone: (0, 0) is
  // a corner of the screen.
  const std::array<Color, 4> expected{Color(0), Color(1, 0, 0), Color(0, 1, 0), Color(0, 0, 1)};
  for (int i = 0; i < 4; ++i) {
    Scene scene = textured_screen(bitmap, 1);
    const double x = i % 2 == 0 ? 0.99999 : 0;  // texel x grows with 1 - u
    const double y = i / 2 == 0 ? 0.99999 : 0;
    set_camera(scene, 1, 0.001, {x, y, 1}, {x, y, 0});
    const Image image = render(scene, 4).image;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(image.at(0, 0, c), expected.at(static_cast<std::size_t>(i))[c], 1e-4) << i;
  }
}

// Colours of 8 bits are linear unless sRGB is asked for; half way between two texels the mean is
// seen.
TEST(Textures, interpolation_and_decoding) {
  BitmapTexture bitmap;
  bitmap.width = 2;
  bitmap.height = 1;
  bitmap.texels = {0x000080, 0x0000ff};
  Scene scene = textured_screen(bitmap, 1);
  set_camera(scene, 1, 0.0001, {0.5, 0, 1}, {0.5, 0, 0});
  EXPECT_NEAR(render(scene, 1).image.at(0, 0, 0), 128 / 255.0 + 1, 1e-4);
  std::get<BitmapTexture>(scene.textures[0]).srgb = true;
  EXPECT_NEAR(render(scene, 1).image.at(0, 0, 0), std::pow((128 / 255.0 + 0.055) / 1.055, 2.4) + 1,
              1e-4);
}

}  // namespace
}  // namespace facet::test
