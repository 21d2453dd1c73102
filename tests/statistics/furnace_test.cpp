// Scenes whose radiance is known.
#include <cmath>
#include <numbers>

#include "compare/z_test.h"
#include "support/render.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

/// Every case of this file is one test of a mean.
constexpr int case_count = 160;

void expect_mean(const Image& image, double expected) {
  test::expect_mean(image, Color(static_cast<float>(expected)), critical_distance(case_count));
}

/// A closed room that emits 1 from every wall and reflects rho of what arrives. It is round: in the
/// corners of a box, light sampled by area has no finite variance, and its mean no error to be
/// compared with.
Scene furnace(const std::string& integrator, float rho) {
  Scene scene = make_scene(integrator);
  add_mesh(scene, make_sphere(2, true), bsdf::Diffuse{Color(rho)}, Color(1));
  set_camera(scene, 8, 90, {0.2, 0.1, -0.3}, {0.3, 0.2, 1});
  return scene;
}

class Furnace : public testing::TestWithParam<std::tuple<const char*, float>> {};

TEST_P(Furnace, has_its_analytic_radiance) {
  const auto [integrator, rho] = GetParam();
  const bool direct = std::string_view(integrator).starts_with("direct");
  const Rendered r = render(furnace(integrator, rho), 512);
  expect_mean(r.image, direct ? 1 + rho : 1 / (1 - rho));
}

INSTANTIATE_TEST_SUITE_P(All, Furnace,
                         testing::Combine(testing::Values("direct_ems", "direct_mats", "direct_mis",
                                                          "path_ems", "path_nee", "path_mats",
                                                          "path_mis", "path"),
                                          testing::Values(0.0F, 0.5F, 0.8F)));

/// Walls that keep nearly all light: with a constant limit of the survival, 0.95, the variance was
/// infinite from an albedo of 0.975 on, and images were too dark with an estimated error that did
/// not show it.
TEST(Furnace, bright_walls_keep_their_light) {
  for (const char* integrator : {"path_ems", "path_mats", "path_mis"}) {
    expect_mean(render(furnace(integrator, 0.99F), 1024).image,
                1 / (1 - static_cast<double>(0.99F)));
  }
  expect_mean(render(furnace("path_mis", 0.999F), 128).image,
              1 / (1 - static_cast<double>(0.999F)));
}

/// Nothing takes light away in a room of mirrors: its paths end by roulette alone.
TEST(Furnace, paths_in_a_room_of_mirrors_end) {
  Scene scene = make_scene("path_mats");
  add_mesh(scene, make_room(1), bsdf::Mirror{});
  add_mesh(scene, make_quad({-0.1F, 0, 0}, {0.1F, 0, 0}, {0.1F, 0.1F, 0}, {-0.1F, 0.1F, 0}),
           bsdf::Diffuse{Color(0)}, Color(1));
  set_camera(scene, 8, 90, {0.2, 0.1, -0.3}, {0.3, 0.2, 1});
  EXPECT_GT(mean_of(render(scene, 64).image, 0).value, 0);
}

TEST(Furnace, max_depth_counts_interactions) {
  for (const int depth : {0, 1, 2, 5}) {
    for (const char* integrator : {"path_ems", "path_mats", "path_mis"}) {
      Scene scene = furnace(integrator, 0.5F);
      scene.integrator.max_depth = depth;
      const double expected = (1 - std::pow(0.5, depth + 1)) / 0.5;
      expect_mean(render(scene, 256).image, expected);
    }
  }
}

TEST(Furnace, power_heuristic_is_unbiased) {
  Scene scene = furnace("path_mis", 0.5F);
  scene.integrator.heuristic = Heuristic::power;
  expect_mean(render(scene, 512).image, 2);
}

TEST(Furnace, constant_environment_gives_albedo) {
  for (const char* integrator : {"direct_ems", "direct_mats", "direct_mis"}) {
    Scene scene = make_scene(integrator);
    add_mesh(scene, make_quad({-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}),
             bsdf::Diffuse{Color(0.6F)});
    scene.emitters.emplace_back(EnvironmentEmitter{1, 1, {Color(2)}});
    set_camera(scene, 8, 5, {0, 3, 0}, {0, 0, 0}, {0, 0, 1});
    expect_mean(render(scene, 512).image, 1.2);
  }
}

TEST(Furnace, every_filter_keeps_a_constant) {
  for (const Filter& filter :
       {Filter(GaussianFilter{}), Filter(MitchellFilter{}), Filter(MitchellFilter{2, -1, 0}),
        Filter(MitchellFilter{2, 1, -0.25}), Filter(TentFilter{}), Filter(BoxFilter{})}) {
    Scene scene = furnace("direct_ems", 0.0F);
    scene.camera.filter = filter;
    expect_mean(render(scene, 4096).image, 1);
  }
}

TEST(Furnace, ambient_occlusion_of_a_lone_plane_is_one) {
  Scene scene = make_scene("ao");
  add_mesh(scene, make_quad({-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}), bsdf::Diffuse{});
  set_camera(scene, 8, 5, {0, 3, 0}, {0, 0, 0}, {0, 0, 1});
  expect_mean(render(scene, 64).image, 1);
}

TEST(FirstHit, depth_is_the_distance_and_normals_are_absolute) {
  Scene scene = make_scene("depth");
  // Tilted, winding downwards: the normal is (0, -0.8, 0.6).
  add_mesh(scene, make_quad({-4, -3, -4}, {4, -3, -4}, {4, 3, 4}, {-4, 3, 4}), bsdf::Diffuse{});
  set_camera(scene, 4, 0.001, {0, 5, 0}, {0, 0, 0}, {0, 0, 1});
  const Rendered depth = render(scene, 4);
  EXPECT_NEAR(depth.image.at(1, 2, 0), 5, 1e-4);
  set_integrator(scene, "normals");
  const Rendered normals = render(scene, 4);
  EXPECT_NEAR(normals.image.at(1, 2, 0), 0, 1e-6);
  EXPECT_NEAR(normals.image.at(1, 2, 1), 0.8, 1e-6);
  EXPECT_NEAR(normals.image.at(1, 2, 2), 0.6, 1e-6);
  scene.meshes.clear();
  EXPECT_EQ(render(scene, 4).image.at(1, 2, 1), 0);
}

/// Radiance leaving a diffuse floor under a polygonal light of radiance 1 (J. H. Lambert's formula
/// for the irradiance).
double lambert_radiance(const dvec3& p, const dvec3& n, const std::vector<dvec3>& polygon,
                        double albedo) {
  dvec3 sum(0);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec3 a = glm::normalize(polygon[i] - p);
    const dvec3 b = glm::normalize(polygon[(i + 1) % polygon.size()] - p);
    sum += std::acos(glm::dot(a, b)) * glm::normalize(glm::cross(a, b));
  }
  return albedo / std::numbers::pi * 0.5 * std::abs(glm::dot(sum, n));
}

TEST(PolygonalLight, lights_a_diffuse_floor_as_lambert_says) {
  for (const char* integrator :
       {"direct_ems", "direct_mats", "direct_mis", "path_ems", "path_mats", "path_mis"}) {
    Scene scene = make_scene(integrator);
    add_mesh(scene, make_quad({-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}),
             bsdf::Diffuse{Color(0.7F)});
    // Faces down; black, so that a path ends on it.
    add_mesh(scene, make_quad({0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}), bsdf::Diffuse{Color(0)},
             Color(1));
    set_camera(scene, 8, 0.01, {-2, 2, -1.5}, {-0.4, 0, 0.3});
    const double expected = lambert_radiance({-0.4, 0, 0.3}, {0, 1, 0},
                                             {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}, 0.7);
    expect_mean(render(scene, 4096).image, expected);
  }
}

TEST(Film, sums_of_2_to_the_24_samples_do_not_stall) {
  Scene scene = make_scene("direct_mats");
  add_mesh(scene, make_room(1), bsdf::Diffuse{Color(0)}, Color(0.1F, 1.0F, 1e-20F));
  set_camera(scene, 1, 1, {0, 0, 0}, {0, 0, 1});
  RenderSettings settings = whole_image(scene, 1 << 24);
  settings.variance = false;
  const Rendered r = render(scene, settings);
  EXPECT_EQ(r.film.pixels[0].samples, 1U << 24U);
  EXPECT_FLOAT_EQ(r.image.at(0, 0, 0), 0.1F);
  EXPECT_FLOAT_EQ(r.image.at(0, 0, 1), 1.0F);
  EXPECT_FLOAT_EQ(r.image.at(0, 0, 2), 1e-20F);
}

}  // namespace
}  // namespace facet::test
