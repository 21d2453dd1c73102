#include "support/render.h"

#include <cmath>

#include "compare/z_test.h"
#include "reference/reference_backend.h"
#include "scene/reader.h"
#include "statistics/hypothesis.h"

namespace facet::test {

KernelBackend& kernel_backend() {
  static KernelBackend backend("", true);
  return backend;
}

RenderSettings whole_image(const Scene& scene, int spp) {
  RenderRequest request;
  request.samples = spp;
  request.variance = true;
  // Where no integrator is named, none matters.
  if (scene.integrator.type.name.empty()) request.integrator = "normals";
  return resolve(scene, request);
}

void expect_silent_validation() {
  static std::size_t heard = 0;
  const std::vector<std::string> messages = kernel_backend().validation_messages();
  for (; heard < messages.size(); ++heard) ADD_FAILURE() << "validation: " << messages[heard];
}

Rendered render(const PackedScene& packed) {
  Rendered result;
  {
    Renderer renderer(device(), packed, kernel_backend().kernels());
    renderer.render({});
    result.statistics = renderer.statistics();
    result.film = renderer.film();
  }
  result.image = develop(result.film, packed.settings.variance);
  EXPECT_EQ(result.statistics.bad_samples, 0U);
  EXPECT_EQ(result.statistics.bound_hits, 0U);
  expect_silent_validation();
  return result;
}

Film render_reference(const Scene& scene, const RenderSettings& settings, Precision precision) {
  const auto backend = reference::make_backend(precision);
  const auto rendering = backend->start(borrowed(scene), settings);
  rendering->run({});
  EXPECT_EQ(rendering->statistics().bad_samples, 0U);
  return rendering->film();
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
    EXPECT_NEAR(mean.value, expected[c],
                critical * mean.error + 3e-6 * static_cast<double>(expected[c]))
        << "channel " << c << ", standard error " << mean.error;
  }
}

double critical_distance(int tests) {
  return statistics::two_sided_normal_quantile(
      statistics::sidak_significance(0.01, static_cast<std::uint64_t>(tests)));
}

bool agree(const Image& a, const Image& b, double significance, std::string& description) {
  const double share = statistics::sidak_significance(significance, 2);
  const ZTestResult small = z_test(a, b, share);
  // Passed even where some cannot be tested: there are few, and one with rare bright samples would
  // be more than the hundredth of them that may be so.
  const ZTestResult large = z_test(a, b, share, {.least = largest_cell, .contributions = 1000});
  description = small.describe() + "; " + large.describe();
  return small.passed() && large.largest_z <= large.critical_z && large.unequal == 0;
}

void expect_agreement(const Image& a, const Image& b, double significance,
                      const std::string& what) {
  std::string description;
  EXPECT_TRUE(agree(a, b, significance, description)) << what << ": " << description;
}

Scene load_scene(const std::string& name) {
  Diagnostics diagnostics(true);
  return read_scene(std::string(FACET_SCENES) + "/" + name, diagnostics);
}

}  // namespace facet::test
