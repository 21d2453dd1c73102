#pragma once
// Everything a render keeps on the device: buffers, bindings, pipelines.
#include <array>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "gpu/pipeline.h"
#include "gpu/stopwatch.h"
#include "render/geometry_buffers.h"
#include "render/render_kernels.h"
#include "render/renderer.h"

namespace facet {

/// Bounces recorded at a time at most.
inline constexpr std::uint32_t bounces_per_submission = 8;

/// A contiguous part of the film, as large as a device's storage buffers may be.
struct FilmPiece {
  std::uint32_t first_pixel = 0;
  std::uint32_t pixel_count = 0;
};

/// The film as the device keeps it.
struct FilmRecords {
  std::vector<shared::FilmRecord> sums;
  std::vector<shared::FilmRecord> squares;  ///< empty unless the variance is kept
};

struct Renderer::Resources {
 public:
  Resources(gpu::Device& device, const PackedScene& packed);

  /// To be called before any use of the kernels, which includes the drivers' compiling at a first
  /// dispatch.
  void compile_kernels();

  /// Binds the buffers, with one piece of the film.
  void bind(const vk::raii::CommandBuffer& c, std::size_t film_piece) const;
  /// Sets all counters to 0 but that of the first queue, which holds the slots in order after
  /// generate.
  void clear_counters(const vk::raii::CommandBuffer& c, std::uint32_t slots) const;
  /// One bounce of all paths in the queue.
  void record_bounce(const vk::raii::CommandBuffer& c, const shared::PassConstants& constants);
  /// The finished samples into the film.
  void record_film(const vk::raii::CommandBuffer& c, shared::PassConstants constants);
  /// The camera's rays alone.
  void record_camera_rays(const vk::raii::CommandBuffer& c, const shared::PassConstants& constants);

  /// Where stages are timed: begins a submission; ends a stage of it; adds up what a finished one
  /// took.
  void start_clock(const vk::raii::CommandBuffer& c);
  void end_stage(const vk::raii::CommandBuffer& c, Stage stage);
  void read_clock(std::span<double> seconds);

  [[nodiscard]] vk::Buffer counters() const { return counters_.handle(); }
  [[nodiscard]] std::array<std::uint32_t, shared::COUNTER_WORDS> read_counters() const;
  [[nodiscard]] FilmRecords read_film() const;
  [[nodiscard]] std::vector<shared::RayRecord> read_rays(std::uint32_t count) const;
  [[nodiscard]] std::vector<shared::PathRecord> read_paths(std::uint32_t count) const;

  /// Of all kernels, in SPIR-V.
  [[nodiscard]] std::uint64_t instruction_count() const { return kernels_.instruction_count(); }

  [[nodiscard]] std::uint32_t pixel_count() const { return pixel_count_; }
  [[nodiscard]] std::uint32_t slot_count() const { return slot_count_; }
  [[nodiscard]] const std::vector<FilmPiece>& film_pieces() const { return pieces_; }
  /// (first pixel, count) of a piece's passes: at most slot_count() pixels each.
  [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> pixel_ranges(
      std::size_t piece) const;

 private:
  void use(const vk::raii::CommandBuffer& c, const vk::raii::Pipeline& pipeline,
           const shared::PassConstants& constants) const;
  void make_film();
  void bind_everything();
  /// The bindings with views of those that are read as texels.
  std::vector<gpu::Binding> with_texels(std::vector<gpu::Binding> bindings);

  gpu::Device& device_;
  std::size_t rounds_;  ///< of a bounce: one for each emitter where all are sampled
  bool variance_;
  std::uint32_t pixel_count_;
  std::uint32_t slot_count_;
  std::vector<FilmPiece> pieces_;
  GeometryBuffers geometry_;
  gpu::Layout layout_;
  std::vector<gpu::Buffer> scene_;  ///< by binding, from BINDING_NORMAL_INDICES on
  gpu::Buffer frame_;
  gpu::Buffer rays_;
  gpu::Buffer hits_;
  gpu::Buffer paths_;
  gpu::Buffer queues_;
  gpu::Buffer counters_;
  std::vector<gpu::Buffer> film_;                 ///< one a piece
  std::vector<gpu::Buffer> squares_;              ///< likewise; a single dummy without variance
  std::deque<vk::raii::BufferView> texel_views_;  ///< of what is bound as texels
  std::vector<gpu::BindingSet> sets_;             ///< one a piece
  RenderKernels kernels_;
  std::optional<gpu::Stopwatch> stopwatch_;
};

}  // namespace facet
