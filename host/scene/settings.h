#pragma once
// What is rendered, with every choice made: the scene's word, or the caller's where there is one.
#include <facet/film.h>

#include <bit>

#include "convergence/sampling_plan.h"
#include "scene/scene.h"

namespace facet {

struct RenderSettings {
  ImageSize size;  ///< of the whole image
  Crop crop;
  SampleRange samples{0, 1};
  std::optional<Division> division;  ///< what `crop` and `samples` are a share of
  std::uint32_t seed = 0;
  Integrator integrator;
  Sampler sampler = Sampler::independent;
  std::uint32_t planned = 1;       ///< samples of each pixel that zsobol puts in order
  std::optional<Masking> masking;  ///< instead of that of the scene's BSDFs
  LobeSampling sampling = LobeSampling::visible;
  bool is_part = false;   ///< its sums are merged with others
  bool variance = false;  ///< keep sums of squares
  bool adaptive = false;  ///< pixels get samples by their variance; `samples` says how many on
                          ///< average, from 0 on
  bool probes = false;    ///< some pixels get a second estimate
  std::optional<double> error;                ///< that is enough; `samples` is the most then
  std::optional<Clock::time_point> deadline;  ///< likewise

  // Of the kernels alone; no result depends on them.
  /// Read from storage buffers even where texel buffers would do; for tests.
  bool force_storage_buffers = false;
  /// Paths in flight, 0: chosen for the device; for tests and measurements.
  std::uint32_t paths_in_flight = 0;
  /// Measure the seconds of each stage.
  bool time_stages = false;

  [[nodiscard]] int crop_width() const { return crop.x1 - crop.x0; }
  [[nodiscard]] int crop_height() const { return crop.y1 - crop.y0; }
  [[nodiscard]] std::uint32_t samples_per_pixel() const { return samples.end - samples.begin; }
  /// Over all pixels of the crop.
  [[nodiscard]] std::uint64_t total_samples() const {
    return std::uint64_t{samples_per_pixel()} * static_cast<std::uint64_t>(crop_width()) *
           static_cast<std::uint64_t>(crop_height());
  }
  /// Of the power of two of samples that zsobol puts in order.
  [[nodiscard]] std::uint32_t order_bits() const {
    return static_cast<std::uint32_t>(std::bit_width(planned - 1));
  }
  [[nodiscard]] SamplingGoal goal() const {
    return {crop_width(), crop_height(), samples, seed, adaptive, probes, error, deadline};
  }
  /// The crop's place in the whole image.
  [[nodiscard]] ImageWindow window() const { return {crop.x0, crop.y0, size.width, size.height}; }
};

/// The settings of a render of the scene as the request wants it. Throws InputError for a request
/// that nothing can meet: an unknown integrator or sampler, none at all, a size beyond
/// check_image_size, pixels outside the image, a range without samples, or shares of which some
/// would be empty.
[[nodiscard]] RenderSettings resolve(const Scene& scene, const RenderRequest& request);

/// The scene's camera with the settings' size of the image.
[[nodiscard]] Camera camera_of(const Scene& scene, const RenderSettings& settings);

/// The scene's BSDFs with the settings' masking function.
[[nodiscard]] std::vector<Bsdf> bsdfs_of(const Scene& scene, const RenderSettings& settings);

/// What the settings alone say of a render.
[[nodiscard]] RenderRecord record_of(const RenderSettings& settings);

/// What can be said of a render before it has begun: all of the record but who renders, and the
/// time.
[[nodiscard]] RenderRecord record_of(const Scene& scene, const RenderSettings& settings);

}  // namespace facet
