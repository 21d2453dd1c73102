#include "support/render.h"

#include <cmath>

#include "image/z_test.h"
#include "scene/reader.h"
#include "statistics/hypothesis.h"

namespace facet::test {

namespace {

gpu::Instance& instance() {
  static gpu::Instance instance(true);
  return instance;
}

}  // namespace

RenderSettings whole_image(const Scene& scene, int spp) {
  RenderSettings settings;
  settings.crop = {0, 0, scene.camera.width, scene.camera.height};
  settings.end_sample = static_cast<std::uint32_t>(spp);
  settings.seed = scene.seed;
  settings.variance = true;
  return settings;
}

gpu::Device make_device() { return {instance(), instance().choose("")}; }

void expect_silent_validation() {
  static std::size_t heard = 0;
  const auto& messages = instance().validation().messages;
  for (; heard < messages.size(); ++heard) ADD_FAILURE() << "validation: " << messages[heard];
}

Rendered render(const PackedScene& packed, const Features& features, const RenderSettings& settings) {
  gpu::Device device = make_device();
  Rendered result;
  {
    Renderer renderer(device, packed, features, settings);
    renderer.render([](double, const RenderStatistics&) { return true; });
    result.statistics = renderer.statistics();
    result.film = renderer.film();
  }
  result.image = develop(result.film, settings.variance);
  EXPECT_EQ(result.statistics.bad_samples, 0U);
  EXPECT_EQ(result.statistics.bound_hits, 0U);
  expect_silent_validation();
  return result;
}

void set_integrator(Scene& scene, const std::string& name) {
  const auto type = find_integrator_type(name);
  ASSERT_TRUE(type) << name;
  scene.integrator.type = *type;
}

Mean mean_of(const Image& image, int channel) {
  Mean mean;
  double variance = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      mean.value += image.at(x, y, channel);
      variance += image.at(x, y, 3 + channel);
    }
  }
  const double pixels = static_cast<double>(image.width()) * image.height();
  mean.value /= pixels;
  mean.error = std::sqrt(variance) / pixels;
  return mean;
}

void expect_mean(const Image& image, const Color& expected, double critical) {
  for (int c = 0; c < 3; ++c) {
    const Mean mean = mean_of(image, c);
    EXPECT_NEAR(mean.value, expected[c], critical * mean.error + 3e-6 * static_cast<double>(expected[c]))
        << "channel " << c << ", standard error " << mean.error;
  }
}

double critical_distance(int tests) {
  return two_sided_normal_quantile(statistics::sidak_significance(0.01, static_cast<std::uint64_t>(tests)));
}

Scene load_scene(const std::string& name) {
  Diagnostics diagnostics(true);
  return read_scene(std::string(FACET_SCENES) + "/" + name, diagnostics);
}

}  // namespace facet::test
