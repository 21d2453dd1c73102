// Emitters in scenes whose radiance is known.
#include <cmath>
#include <numbers>

#include "statistics/analytic.h"
#include "support/polygon.h"

namespace facet::test {
namespace {

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

/// Variance of a sample over the square of its mean: of a floor under an even sky and two lamps in
/// equal distance, where one emitter is sampled.
double relative_variance_under(float sky, float lamps) {
  Scene scene = make_scene("direct_ems");
  add_mesh(scene, make_quad({-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}),
           bsdf::Diffuse{Color(0.5F)});
  scene.emitters.emplace_back(EnvironmentEmitter{1, 1, {Color(sky)}});
  for (const float x : {-2.0F, 2.0F})
    scene.emitters.emplace_back(PointLight{vec3(x, 3, 0), Color(lamps)});
  set_camera(scene, 16, 0.001, {0, 2, -2}, {0, 0, 0});
  constexpr int spp = 1024;
  const Image image = render(scene, spp).image;
  const Mean mean = mean_of(image, 0);
  const double samples = 16.0 * 16.0 * spp;
  return samples * mean.error * mean.error / (mean.value * mean.value);
}

/// However bright the one is and however dark the other, a quarter of the samples goes to each. Of
/// the sky, whose directions are evenly distributed, the square of a sample that gets all of them
/// is 8/3 of that of its mean on average.
TEST(EmitterSelection, keeps_a_quarter_for_the_sky_and_one_for_the_lamps) {
  // The variance's own error is 0.3 %.
  EXPECT_NEAR(relative_variance_under(1e-6F, 1), 1 / 0.75 - 1, 0.005);
  EXPECT_NEAR(relative_variance_under(1, 1e-6F), 8.0 / 3 / 0.75 - 1, 0.03);
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
