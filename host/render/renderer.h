#pragma once
// Renders a scene on a device: wavefront path tracing in bounded passes.
#include <facet/backend.h>

#include "convergence/sampling_plan.h"
#include "gpu/stopwatch.h"
#include "render/film_buffers.h"
#include "render/kernel_store.h"
#include "render/path_state.h"
#include "render/scene_buffers.h"
#include "render/stages.h"

namespace facet {

/// A scene on a device, ready to be rendered once.
class Renderer : private SampleSource {
 public:
  /// Uploads the scene and compiles its kernels, unless the store has them. Throws InputError if it
  /// does not fit the device.
  Renderer(gpu::Device& device, const PackedScene& packed, KernelStore& store);
  /// With kernels of its own.
  Renderer(gpu::Device& device, const PackedScene& packed);

  /// Renders until the settings' goal is met, or as long as `progress` lets it.
  SamplingOutcome render(const ProgressCallback& progress);

  [[nodiscard]] const RenderStatistics& statistics() const { return statistics_; }
  [[nodiscard]] const SamplingPlan& plan() const { return plan_; }
  /// Seconds of each stage, where the settings ask for them.
  [[nodiscard]] const StageSeconds& stage_seconds() const { return stage_seconds_; }
  /// The film so far; its record is empty.
  [[nodiscard]] Film film() const;

  /// What it has come to; the record is left empty. Where `progress` is told, or before or after a
  /// render.
  [[nodiscard]] RenderState state() const;
  /// Takes the state of another renderer with these settings, before the render. Throws
  /// std::invalid_argument for one that cannot be.
  void restore(const RenderState& state);

  /// Renders one more sample of every pixel of the crop; returns their radiances (W sr^-1 m^-2)
  /// before the filter's weight, row by row.
  [[nodiscard]] std::vector<Radiance> render_sample(std::uint32_t sample);

  /// The camera's rays of sample 0, one a pixel of the crop, as many as there are paths in flight;
  /// for benchmarks and tests.
  [[nodiscard]] std::vector<shared::RayRecord> camera_rays();

 private:
  Renderer(gpu::Device& device, const PackedScene& packed, std::shared_ptr<RenderProgram> program);

  /// One pass: samples of pixels of one piece of the film.
  struct Wave {
    Sums sums = Sums::image;
    std::size_t film_piece = 0;
    shared::PassConstants constants{};
  };

  // As a source of samples.
  bool add(const SamplingTask& task, std::uint32_t& next) override;
  [[nodiscard]] Film sums(Sums of) const override;
  void clear(Sums which) override { films_.at(static_cast<std::size_t>(which)).clear(); }
  void expect(double samples) override;

  void compile_kernels();
  /// Lists pixels of the crop for the kernels that read lists: all where there are none, or these
  /// in ascending order.
  void list_pixels(const PixelList& pixels);
  /// Calls the progress; returns whether to go on.
  bool tell();
  /// A task's samples of `count` pixels of a piece of the film, or of the list, from `next` on;
  /// returns whether to go on.
  bool run_waves(const SamplingTask& task, std::size_t film_piece, std::uint32_t& next,
                 std::uint32_t count);
  bool add_all(const SamplingTask& task, std::uint32_t& next);
  bool add_listed(const SamplingTask& task, std::uint32_t& next);
  [[nodiscard]] Wave make_wave(std::size_t film_piece, std::uint32_t first_pixel,
                               std::uint32_t pixel_count, std::uint32_t first_sample,
                               std::uint32_t sample_count) const;
  void run_wave(const Wave& wave);
  /// One bounce of all paths in the queue.
  void record_bounce(gpu::Commands& commands, const shared::PassConstants& constants);
  /// The finished samples into the film.
  void record_film(gpu::Commands& commands, shared::PassConstants constants);
  /// Where stages are timed: records a submission, runs it, and adds up what its stages took.
  template <typename Record>
  void run_timed(const Wave& wave, const Record& record);
  void end_stage(const gpu::Commands& commands, Stage stage);

  [[nodiscard]] const RenderKernels& kernels() const { return program_->kernels; }
  [[nodiscard]] const FilmBuffers& image() const { return films_.front(); }

  gpu::Device& device_;
  RenderSettings settings_;
  SamplingPlan plan_;
  Features features_;
  float square_scale_;
  std::uint32_t seed_;    ///< of the samples that are being rendered
  std::uint32_t rounds_;  ///< of a bounce: one for each emitter where all are sampled
  RenderStatistics statistics_;
  std::chrono::steady_clock::time_point start_;  ///< of rendering
  ProgressCallback progress_;
  StageSeconds stage_seconds_{};
  SceneBuffers scene_;
  PathState state_;
  std::vector<FilmBuffers> films_;  ///< the image's sums and, where there are such, the trial's
  gpu::Buffer listed_;              ///< pixels of passes, where they are listed
  std::shared_ptr<RenderProgram> program_;
  std::vector<std::vector<gpu::BoundBuffers>> bound_;  ///< one a piece of each film
  std::optional<gpu::Stopwatch> stopwatch_;
};

}  // namespace facet
