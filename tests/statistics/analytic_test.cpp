// Materials, textures and emitters in scenes whose radiance is known.
#include <cmath>
#include <numbers>

#include "support/polygon.h"
#include "support/render.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

/// Tests of means in this file, three channels each.
constexpr int case_count = 600;

void expect_radiance(Scene scene, const std::string& integrator, int spp, const dvec3& expected) {
  SCOPED_TRACE(integrator);
  set_integrator(scene, integrator);
  expect_mean(render(scene, spp).image, Color(expected), critical_distance(case_count));
}

const std::vector<std::string>& all_estimators() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const IntegratorType& type : integrator_types()) {
      if (type.emitter_sampling || type.material_sampling) list.emplace_back(type.name);
    }
    return list;
  }();
  return names;
}

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

TEST(PointLight, lights_a_diffuse_floor_exactly) {
  Scene scene = make_scene("direct_ems");
  add_mesh(scene, make_quad({-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}),
           bsdf::Diffuse{Color(0.6F)});
  scene.emitters.emplace_back(PointLight{{3, 4, 0}, Color(5, 10, 20)});
  set_camera(scene, 4, 0.001, {-3, 2, 0}, {0, 0, 0});
  const double irradiance_of_one = 0.8 / 25;
  const dvec3 expected = dvec3(5, 10, 20) * (0.6 / std::numbers::pi * irradiance_of_one);
  for (const char* integrator :
       {"direct_ems", "direct_mis", "direct_whitted", "whitted", "path_ems", "path_mis"}) {
    set_integrator(scene, integrator);
    const Image image = render(scene, 16).image;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(mean_of(image, c).value / expected[c], 1, 1e-4) << integrator;
  }
  expect_radiance(scene, "path_mats", 16, dvec3(0));
  // A second one: choosing one of the two brings noise, taking both none.
  scene.emitters.emplace_back(PointLight{{-3, 4, 0}, Color(1)});
  for (const char* integrator : {"direct_ems", "direct_mis"})
    expect_radiance(scene, integrator, 4096,
                    expected + dvec3(0.6 / std::numbers::pi * irradiance_of_one));
}

/// A point light above a ground so large that its sky has all the power: by power alone the light
/// would never be asked.
TEST(PointLight, is_seen_however_large_the_scene_is) {
  Scene scene = make_scene("path_mis");
  add_mesh(scene, make_quad({-1e4, 0, -1e4}, {-1e4, 0, 1e4}, {1e4, 0, 1e4}, {1e4, 0, -1e4}),
           bsdf::Diffuse{Color(0.5F)});
  scene.emitters.emplace_back(EnvironmentEmitter{1, 1, {Color(1)}});
  scene.emitters.emplace_back(PointLight{{0, 3, 0}, Color(1000)});
  set_camera(scene, 4, 0.01, {0, 2, -2}, {0, 0, 0});
  expect_radiance(scene, "path_mis", 16384, dvec3(0.5 + 0.5 / std::numbers::pi * 1000 / 9));
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
  add_mesh(scene, mesh, bsdf::Diffuse{Color(0)}, Color(2));
  std::get<AreaEmitter>(scene.emitters.front()).texture = 0;
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

/// Irradiance per unit albedo/pi of a floor under the environment of one bright texel, integrated
/// over its neighbourhood.
double irradiance_of_texel(int width, int height, int column, int row) {
  const auto tent = [](double distance) { return std::max(0.0, 1 - std::abs(distance)); };
  double sum = 0;
  constexpr int steps = 400;
  for (int j = 0; j < 2 * steps; ++j) {
    const double y = row - 1 + (j + 0.5) / steps;  // image coordinate
    const double theta = std::numbers::pi * (1 - y / height);
    for (int i = 0; i < 2 * steps; ++i) {
      const double x = column - 1 + (i + 0.5) / steps;
      sum += tent(x - column) * tent(y - row) * std::max(0.0, std::cos(theta)) * std::sin(theta);
    }
  }
  const double cell =
      (2 * std::numbers::pi / width) * (std::numbers::pi / height) / (steps * steps);
  return sum * cell;
}

TEST(Environment, of_one_bright_texel_lights_a_floor) {
  EnvironmentEmitter sky{16, 8, std::vector<Color>(128, Color(0))};
  sky.texels[6 * 16 + 5] = Color(100, 50, 25);
  Scene scene = make_scene("direct_ems");
  add_mesh(scene, make_quad({-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}),
           bsdf::Diffuse{Color(0.6F)});
  scene.emitters.emplace_back(sky);
  set_camera(scene, 4, 1, {-3, 4, 0}, {0, 0, 0});
  const dvec3 expected =
      dvec3(100, 50, 25) * (0.6 / std::numbers::pi * irradiance_of_texel(16, 8, 5, 6));
  for (const std::string& integrator : all_estimators())
    expect_radiance(scene, integrator, 16384, expected);
}

/// An emitter of 500,000 triangles of which each has less than a word's share of the area: another
/// one, large and facing away, has the rest. The density of a sample must be the probability with
/// which it was taken.
TEST(AreaLight, of_very_unequal_triangles_has_the_density_that_is_used) {
  constexpr int n = 500;
  std::vector<vec3> corners;
  const auto at = [](int i, int j) {
    return vec3(static_cast<float>(i) / n - 0.5F, 1, static_cast<float>(j) / n - 0.5F);
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      corners.insert(corners.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      corners.insert(corners.end(), {at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  corners.insert(corners.end(), {{-100, 9, -100}, {-100, 9, 100}, {300, 9, -100}});
  Scene scene = make_scene("direct_ems");
  add_mesh(scene, make_quad({-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}),
           bsdf::Diffuse{Color(1)});
  add_mesh(scene, make_mesh(corners), bsdf::Diffuse{Color(0)}, Color(1));
  set_camera(scene, 8, 0.01, {0, 0.5, -0.2}, {0, 0, 0});
  const double irradiance =
      polygon_irradiance({dvec3(-0.5, 1, -0.5), dvec3(0.5, 1, -0.5), dvec3(0.5, 1, 0.5)}) +
      polygon_irradiance({dvec3(-0.5, 1, -0.5), dvec3(0.5, 1, 0.5), dvec3(-0.5, 1, 0.5)});
  const dvec3 expected(std::abs(irradiance) / std::numbers::pi);
  EXPECT_NEAR(expected.x, 0.23946, 1e-4);
  expect_radiance(scene, "direct_ems", 65536, expected);
  expect_radiance(scene, "direct_mis", 256, expected);
}

TEST(SphereLight, lights_a_plane_as_its_triangles_do_and_nearly_as_a_sphere) {
  Scene scene = make_scene("direct_ems");
  Mesh sphere = make_sphere(4, false);
  transform(sphere, 0.5F, {0, 2, 0});
  double irradiance = 0;
  for (const uvec3& t : sphere.position_indices) {
    const std::array<dvec3, 3> p{dvec3(sphere.positions[t.x]), dvec3(sphere.positions[t.y]),
                                 dvec3(sphere.positions[t.z])};
    const bool faces = glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[0]) < 0;
    if (faces) irradiance += std::abs(polygon_irradiance(p));
  }
  EXPECT_NEAR(irradiance / (std::numbers::pi * 0.25 * 0.25), 1, 0.01);
  add_mesh(scene, sphere, bsdf::Diffuse{Color(0)}, Color(3));
  add_mesh(scene, make_quad({-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}),
           bsdf::Diffuse{Color(0.8F)});
  set_camera(scene, 4, 0.01, {-3, 1, 0}, {0, 0, 0});
  for (const std::string& integrator : all_estimators())
    expect_radiance(scene, integrator, 16384, dvec3(3 * 0.8 / std::numbers::pi * irradiance));
}

}  // namespace
}  // namespace facet::test
