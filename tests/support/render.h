#pragma once
// Rendering in tests: on the default device, under the validation layers.
#include <gtest/gtest.h>

#include <string>

#include "render/kernel_backend.h"
#include "render/renderer.h"

namespace facet::test {

struct Rendered {
  Image image;  ///< with variance channels
  Film film;
  RenderStatistics statistics;
};

/// The whole image with `spp` samples.
[[nodiscard]] RenderSettings whole_image(const Scene& scene, int spp);

/// Renders and expects that no sample was bad, no bound was hit, and the validation layers kept
/// silent.
[[nodiscard]] Rendered render(const PackedScene& packed);
[[nodiscard]] inline Rendered render(const Scene& scene, const RenderSettings& settings) {
  return render(pack_scene(scene, settings));
}
[[nodiscard]] inline Rendered render(const Scene& scene, int spp) {
  return render(scene, whole_image(scene, spp));
}

/// The kernels on the default device with validation layers on.
[[nodiscard]] KernelBackend& kernel_backend();
/// Its device.
[[nodiscard]] inline gpu::Device& device() { return kernel_backend().device(); }
/// Expects that the layers have said nothing since the last call.
void expect_silent_validation();

/// The same by the reference.
[[nodiscard]] Film render_reference(const Scene& scene, const RenderSettings& settings,
                                    Precision precision);

/// Sets the integrator by name.
void set_integrator(Scene& scene, const std::string& name);

/// Mean of a channel, and the standard error of that mean from the variance channels.
struct Mean {
  double value = 0;
  double error = 0;
};
[[nodiscard]] Mean mean_of(const Image& image, int channel);

/// Expects the mean of every channel within `critical` standard errors of what is expected; a mean
/// without variance must be exact to rounding.
void expect_mean(const Image& image, const Color& expected, double critical);

/// The critical distance, in standard errors, of one of `tests` two-sided tests of means that err
/// together with probability 0.01.
[[nodiscard]] double critical_distance(int tests);

/// Whether two images estimate the same light, in the smallest cells, which show what is wrong in a
/// few pixels, and in the largest, which show small differences of many. Right ones do not with
/// probability `significance`, about. The description says what was found.
[[nodiscard]] bool agree(const Image& a, const Image& b, double significance,
                         std::string& description);
/// Expects that they do.
void expect_agreement(const Image& a, const Image& b, double significance, const std::string& what);

/// A shipped scene.
[[nodiscard]] Scene load_scene(const std::string& name);

}  // namespace facet::test
