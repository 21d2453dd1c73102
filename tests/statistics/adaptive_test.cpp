// Adaptive sampling has the expectation of even sampling.
#include <cmath>

#include "compare/z_test.h"
#include "image/film.h"
#include "support/render.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

/// Each comparison corrects for its cells; this is shared among the comparisons of this file.
constexpr double significance = 0.01 / 3;

/// A small bright lamp, which few BSDF samples find: what a sample shows, most often, is far below
/// the mean, and whoever stopped where samples agree would stop there.
Scene rare_light() {
  Scene scene = make_scene("direct_mats");
  add_mesh(scene, make_quad({-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}),
           bsdf::Diffuse{Color(0.5F)});
  Mesh lamp = make_sphere(2, false);
  transform(lamp, 0.2F, {0.3F, 0.5F, 0.2F});
  add_mesh(scene, lamp, bsdf::Diffuse{}, Color(20, 10, 5));
  set_camera(scene, 16, 45, {-2, 2, -2}, {0, 0, 0});
  return scene;
}

/// The mean of many renders, and its variance by their differences.
template <typename Render>
Image mean_of_renders(const Scene& scene, int count, const Render& render_one) {
  Film sums = make_film(scene.camera.width, scene.camera.height,
                        {0, 0, scene.camera.width, scene.camera.height}, true);
  for (int k = 0; k < count; ++k) {
    const Film film = render_one(static_cast<std::uint32_t>(k + 1));
    for (std::size_t i = 0; i < film.pixels.size(); ++i) sums.pixels[i].add(film.pixels[i].mean());
  }
  return develop(sums, true);
}

RenderSettings adaptive(const Scene& scene, int spp, Sampler sampler, std::uint32_t seed) {
  RenderSettings settings = whole_image(scene, spp);
  settings.sampler = sampler;
  settings.seed = seed;
  settings.adaptive = settings.variance = true;
  return settings;
}

/// Expects that a mean of adaptive renders agrees with an even one; prints the bias of the whole.
void expect_no_bias(const Image& mean, const Image& truth) {
  double bias = 0;
  double whole = 0;
  for (int i = 0; i < mean.width() * mean.height(); ++i) {
    bias += static_cast<double>(mean.plane(0)[i]) - static_cast<double>(truth.plane(0)[i]);
    whole += static_cast<double>(truth.plane(0)[i]);
  }
  std::printf("bias of the whole image: %.2f %%\n", 100 * bias / whole);
  const ZTestResult result = z_test(mean, truth, significance);
  EXPECT_TRUE(result.passed()) << result.describe();
}

class Adaptive : public testing::TestWithParam<Sampler> {};

TEST_P(Adaptive, sampling_is_unbiased) {
  const Scene scene = rare_light();
  const Image mean = mean_of_renders(scene, 400, [&](std::uint32_t seed) {
    return render_reference(scene, adaptive(scene, 32, GetParam(), seed), Precision::float_);
  });
  expect_no_bias(mean, render(scene, 1 << 16).image);
}

INSTANTIATE_TEST_SUITE_P(Samplers, Adaptive, testing::Values(Sampler::independent, Sampler::sobol),
                         [](const auto& tested) { return std::string(name_of(tested.param)); });

TEST(AdaptiveKernels, have_the_same_expectation) {
  const Scene scene = rare_light();
  const Image mean = mean_of_renders(scene, 60, [&](std::uint32_t seed) {
    return render(scene, adaptive(scene, 32, Sampler::independent, seed)).film;
  });
  expect_no_bias(mean, render(scene, 1 << 14).image);
}

// The samples that one may look at singly are those of every pixel, in order.
TEST(AdaptiveKernels, show_the_samples_of_every_pixel) {
  const Scene scene = rare_light();
  RenderSettings settings = adaptive(scene, 32, Sampler::independent, 1);
  const auto look = [&] {
    return Renderer(device(), pack_scene(scene, settings)).render_sample(3);
  };
  const std::vector<Radiance> listed = look();
  settings.adaptive = false;
  EXPECT_EQ(listed, look());
}

}  // namespace
}  // namespace facet::test
