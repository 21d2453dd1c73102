// Samplers estimate the same, and sobol with less noise.
#include <cmath>
#include <numbers>

#include "support/polygon.h"
#include "support/render.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

/// A diffuse floor under lights of one triangle each or more, which all shine with radiance 1;
/// every pixel sees the same point, so that pixels are repetitions.
struct LitFloor {
  Scene scene = make_scene("direct_ems");
  double radiance = 0;

  explicit LitFloor(const std::vector<Mesh>& lights) {
    for (const Mesh& light : lights) {
      for (const uvec3& t : light.position_indices)
        radiance +=
            std::abs(polygon_irradiance({dvec3(light.positions[t.x]), dvec3(light.positions[t.y]),
                                         dvec3(light.positions[t.z])})) *
            0.8 / std::numbers::pi;
      add_mesh(scene, light, bsdf::Diffuse{Color(0)}, Color(1));
    }
    add_mesh(scene, make_quad({-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}),
             bsdf::Diffuse{Color(0.8F)});
    set_camera(scene, 32, 1e-4, {-3, 1, 0}, {0, 0, 0});
  }
};

Mesh triangle_light() { return make_mesh({{-0.5, 1, -0.5}, {1, 1, -0.5}, {-0.5, 1, 1}}); }
Mesh quad_light() {
  return make_quad({-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5});
}

double relative_rmse(const LitFloor& floor, int spp) {
  const Image image = render(floor.scene, spp).image;
  double sum = 0;
  for (int i = 0; i < image.width() * image.height(); ++i) {
    const double error = image.plane(0)[i] / floor.radiance - 1;
    sum += error * error;
  }
  return std::sqrt(sum / (image.width() * image.height()));
}

TEST(Sampler, errors_fall_faster_under_sobol) {
  LitFloor triangle({triangle_light()});
  std::array<std::array<double, 2>, 4> rmse{};
  for (std::size_t i = 0; i < rmse.size(); ++i) {
    for (const Sampler sampler : {Sampler::independent, Sampler::sobol}) {
      triangle.scene.sampler = sampler;
      const int spp = 16 << 2 * i;
      rmse.at(i).at(static_cast<std::size_t>(sampler)) = relative_rmse(triangle, spp);
    }
    std::printf("%d spp: independent %.3g, sobol %.3g\n", 16 << 2 * i, rmse.at(i)[0],
                rmse.at(i)[1]);
  }
  const auto slope = [&](std::size_t sampler) {
    return std::log2(rmse[3].at(sampler) / rmse[0].at(sampler)) / 6;
  };
  EXPECT_NEAR(slope(0), -0.5, 0.05);
  EXPECT_LT(slope(1), -1);
  for (const auto& [independent, sobol] : rmse) EXPECT_LT(sobol, independent / 3);
}

/// Mean squared error under independent samples over that under sobol.
double gain(LitFloor& floor, int spp) {
  floor.scene.sampler = Sampler::independent;
  const double independent = relative_rmse(floor, spp);
  floor.scene.sampler = Sampler::sobol;
  const double ratio = independent / relative_rmse(floor, spp);
  return ratio * ratio;
}

// Which triangle of a light, and which light, is decided by the numbers that go on to be the point
// on it: a decision with numbers of its own would leave a gain of 8 at any number of samples.
TEST(Sampler, choices_keep_the_order_of_the_points) {
  LitFloor quad({quad_light()});
  LitFloor lights({quad_light(), triangle_light()});
  for (int spp = 16; spp <= 1024; spp *= 4)
    std::printf("%d spp: quad %.3g, quad and triangle %.3g\n", spp, gain(quad, spp),
                gain(lights, spp));
  EXPECT_GT(gain(quad, 1024), 10000);
  EXPECT_GT(gain(lights, 1024), 300);
}

// The estimate of the error that goes with an image takes samples for independent: under sobol it
// is too large.
TEST(Sampler, variance_channels_overestimate_under_sobol) {
  LitFloor triangle({triangle_light()});
  for (const Sampler sampler : {Sampler::independent, Sampler::sobol}) {
    triangle.scene.sampler = sampler;
    const Image image = render(triangle.scene, 256).image;
    const double claimed = mean_of(image, 0).error * image.width() / triangle.radiance;
    const double ratio = claimed / relative_rmse(triangle, 256);
    if (sampler == Sampler::independent) {
      EXPECT_NEAR(ratio, 1, 0.1);
    } else {
      EXPECT_GT(ratio, 3);
    }
  }
}

// The floor sees the light under unlike angles from near: by area, most samples fall where it is
// far.
TEST(Sampler, points_by_solid_angle_serve_near_large_lights) {
  LitFloor wide({make_quad({-4, 0.3F, -4}, {4, 0.3F, -4}, {4, 0.3F, 4}, {-4, 0.3F, 4})});
  set_camera(wide.scene, 32, 1e-4, {-3, 0.2, 0}, {0, 0, 0});
  const double area = relative_rmse(wide, 64);
  wide.scene.integrator.area_sampling = AreaSampling::solid_angle;
  const double solid_angle = relative_rmse(wide, 64);
  std::printf("by area %.3g, by solid angle %.3g\n", area, solid_angle);
  EXPECT_LT(3 * solid_angle, area);
  // What is left is the cosine at the floor.
  EXPECT_LT(solid_angle, 0.1);
}

/// Mean square of the relative errors of the means of squares of pixels.
double relative_mse(const Image& image, int side, double radiance) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y + side <= image.height(); y += side) {
    for (int x = 0; x + side <= image.width(); x += side) {
      double mean = 0;
      for (int i = 0; i < side * side; ++i)
        mean += static_cast<double>(image.at(x + i % side, y + i / side, 0)) / (side * side);
      sum += (mean / radiance - 1) * (mean / radiance - 1);
      ++count;
    }
  }
  return sum / count;
}

/// Mean squared errors over seeds, of pixels and of squares of 16.
std::array<double, 2> mse_over_seeds(LitFloor& floor, Sampler sampler, int spp) {
  constexpr std::uint32_t seeds = 16;
  std::array<double, 2> mse{};
  floor.scene.sampler = sampler;
  for (floor.scene.seed = 0; floor.scene.seed < seeds; ++floor.scene.seed) {
    const Image image = render(floor.scene, spp).image;
    mse[0] += relative_mse(image, 1, floor.radiance) / seeds;
    mse[1] += relative_mse(image, 4, floor.radiance) / seeds;
  }
  return mse;
}

// Where pixels see nearly the same, zsobol's squares of 16 pixels are as exact as one pixel of 16
// times the samples, and the pixels themselves as under sobol, whose errors are noise: 16 pixels
// have a 16th of the variance. One smooth decision gains most, and one between dark and bright
// least.
TEST(Sampler, errors_of_neighbours_cancel_under_zsobol) {
  LitFloor quad({quad_light()});
  for (const auto& [integrator, spp, gain] :
       {std::tuple{"direct_ems", 16, 20.0}, std::tuple{"direct_mats", 1, 3.0}}) {
    set_integrator(quad.scene, integrator);
    const auto sobol = mse_over_seeds(quad, Sampler::sobol, spp);
    const auto zsobol = mse_over_seeds(quad, Sampler::zsobol, spp);
    std::printf("%s, %d spp: sobol %.3g, 16 pixels %.3g; zsobol %.3g, 16 pixels %.3g\n", integrator,
                spp, sobol[0], sobol[1], zsobol[0], zsobol[1]);
    EXPECT_NEAR(zsobol[0] / sobol[0], 1, 0.15);
    EXPECT_NEAR(16 * sobol[1] / sobol[0], 1, 0.2);
    EXPECT_GT(sobol[1], gain * zsobol[1]);
  }
}

/// Mean and standard error, over seeds, of an image's mean in each channel.
std::array<Mean, 3> means_over_seeds(Scene scene, Sampler sampler, std::uint32_t first_seed) {
  constexpr std::uint32_t seeds = 8;
  scene.sampler = sampler;
  dvec3 sum(0);
  dvec3 squares(0);
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    scene.seed = first_seed + seed;
    const Image image = render(scene, 32).image;
    const dvec3 mean(mean_of(image, 0).value, mean_of(image, 1).value, mean_of(image, 2).value);
    sum += mean;
    squares += mean * mean;
  }
  std::array<Mean, 3> means;
  for (int c = 0; c < 3; ++c) {
    const double mean = sum[c] / seeds;
    means.at(static_cast<std::size_t>(c)) = {
        mean, std::sqrt((squares[c] / seeds - mean * mean) / (seeds - 1))};
  }
  return means;
}

class Samplers : public testing::TestWithParam<const char*> {};

TEST_P(Samplers, estimate_the_same) {
  Scene scene = load_scene(GetParam());
  scene.camera.width = 32;
  scene.camera.height = 24;
  const auto a = means_over_seeds(scene, Sampler::independent, 0);
  for (const Sampler sampler : {Sampler::sobol, Sampler::zsobol}) {
    const auto b = means_over_seeds(scene, sampler, 100);
    for (std::size_t c = 0; c < 3; ++c) {
      std::printf("%.6g +- %.2g, %.6g +- %.2g\n", a.at(c).value, a.at(c).error, b.at(c).value,
                  b.at(c).error);
      // Student's t of 14 degrees of freedom: 0.0008, which is 0.01 over scenes, samplers and
      // channels.
      EXPECT_LT(std::abs(a.at(c).value - b.at(c).value),
                4.25 * std::hypot(a.at(c).error, b.at(c).error));
      EXPECT_LT(b.at(c).error, 0.02 * b.at(c).value);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Samplers,
                         testing::Values("cbox/cbox_conductors_path.xml",
                                         "serapis/serapis_rough_mis.xml"),
                         [](const auto& p) {
                           return std::string(p.param).substr(0, std::string(p.param).find('/'));
                         });

}  // namespace
}  // namespace facet::test
