#include "bench/whole_render.h"

#include <numeric>
#include <optional>

#include "core/clock.h"
#include "render/renderer.h"

namespace facet::bench {

namespace {

/// Renders with one set of kernels.
class RenderSeries {
 public:
  RenderSeries(gpu::Device& device, const PackedScene& packed) : device_(device), packed_(packed) {
    row_.integrator = packed.settings.integrator.type.name;
    row_.samples_per_pixel = packed.settings.samples.end;
  }

  void run() {
    const auto start = std::chrono::steady_clock::now();
    Renderer renderer(device_, packed_);
    if (rates_.empty()) {
      row_.startup_seconds = seconds_since(start);
      row_.compile_seconds = renderer.statistics().compile_seconds;
      row_.device_bytes = renderer.statistics().device_bytes;
      row_.kernel_instructions = renderer.statistics().kernel_instructions;
    }
    renderer.render({});
    last_ = renderer.statistics();
    stages_ = renderer.stage_seconds();
    rates_.push_back(static_cast<double>(last_.samples) / last_.render_seconds);
  }

  [[nodiscard]] RenderRow row(const std::string& name, double packing_seconds) const {
    RenderRow row = row_;
    row.scene = name;
    row.startup_seconds += packing_seconds;
    row.samples_per_second = summarise(rates_);
    const auto rays = static_cast<double>(last_.closest_rays + last_.any_rays);
    row.rays_per_second = row.samples_per_second.median * rays / static_cast<double>(last_.samples);
    const double total = std::accumulate(stages_.begin(), stages_.end(), 0.0);
    for (std::size_t i = 0; i < row.stage_shares.size(); ++i)
      row.stage_shares[i] = total > 0 ? stages_[i] / total : 0;
    return row;
  }

 private:
  gpu::Device& device_;
  const PackedScene& packed_;
  RenderRow row_;
  std::vector<double> rates_;
  RenderStatistics last_;
  StageSeconds stages_{};
};

}  // namespace

std::vector<RenderRow> measure_render(gpu::Device& device, const std::string& name,
                                      const Scene& scene, const WholeRenderOptions& options) {
  RenderRequest request;
  request.samples = static_cast<int>(options.samples_per_pixel);
  RenderSettings settings = resolve(scene, request);
  settings.time_stages = true;
  const auto start = std::chrono::steady_clock::now();
  const PackedScene packed = pack_scene(scene, settings);
  const double packing_seconds = seconds_since(start);
  RenderSeries own(device, packed);
  std::optional<PackedScene> widened;
  std::optional<RenderSeries> everything;
  if (options.with_everything) {
    widened = packed;
    widened->features = packed.features.with_everything();
    everything.emplace(device, *widened);
  }
  for (int run = 0; run < options.repeats; ++run) {
    own.run();
    if (everything) everything->run();
  }
  std::vector<RenderRow> rows{own.row(name, packing_seconds)};
  if (everything) rows.push_back(everything->row(name + ", everything in", packing_seconds));
  return rows;
}

}  // namespace facet::bench
