#include "bench/whole_render.h"

#include <numeric>

#include "core/clock.h"
#include "render/renderer.h"

namespace facet::bench {

namespace {

/// Renders with one set of kernels.
class Series {
 public:
  Series(gpu::Device& device, const Scene& scene, const PackedScene& packed, const Features& features,
         const RenderSettings& settings)
      : device_(device), packed_(packed), features_(features), settings_(settings) {
    row_.integrator = scene.integrator.type.name;
    row_.samples_per_pixel = settings.end_sample;
  }

  void run() {
    const auto start = std::chrono::steady_clock::now();
    Renderer renderer(device_, packed_, features_, settings_);
    if (rates_.empty()) {
      row_.startup_seconds = seconds_since(start);
      row_.compile_seconds = renderer.statistics().compile_seconds;
      row_.device_bytes = renderer.statistics().device_bytes;
      row_.kernel_instructions = renderer.statistics().kernel_instructions;
    }
    renderer.render([](double /*done*/, const RenderStatistics& /*so_far*/) { return true; });
    last_ = renderer.statistics();
    rates_.push_back(static_cast<double>(last_.samples) / last_.render_seconds);
  }

  [[nodiscard]] RenderRow row(const std::string& name, double packing_seconds) const {
    RenderRow row = row_;
    row.scene = name;
    row.startup_seconds += packing_seconds;
    row.samples_per_second = summarise(rates_);
    const auto rays = static_cast<double>(last_.closest_rays + last_.any_rays);
    row.rays_per_second = row.samples_per_second.median * rays / static_cast<double>(last_.samples);
    const double total = std::accumulate(last_.stage_seconds.begin(), last_.stage_seconds.end(), 0.0);
    for (std::size_t i = 0; i < row.stage_shares.size(); ++i)
      row.stage_shares[i] = total > 0 ? last_.stage_seconds[i] / total : 0;
    return row;
  }

 private:
  gpu::Device& device_;
  const PackedScene& packed_;
  Features features_;
  RenderSettings settings_;
  RenderRow row_;
  std::vector<double> rates_;
  RenderStatistics last_;
};

}  // namespace

std::vector<RenderRow> measure_render(gpu::Device& device, const std::string& name, const Scene& scene,
                                      const RenderOptions& options) {
  RenderSettings settings;
  settings.crop = {0, 0, scene.camera.width, scene.camera.height};
  settings.seed = scene.seed;
  settings.end_sample = options.samples_per_pixel;
  settings.time_stages = true;
  const auto start = std::chrono::steady_clock::now();
  const PackedScene packed = pack_scene(scene);
  const double packing_seconds = seconds_since(start);
  const Features features = find_features(scene, settings);
  Series own(device, scene, packed, features, settings);
  Series everything(device, scene, packed, features.with_everything(), settings);
  for (int run = 0; run < options.repeats; ++run) {
    own.run();
    if (options.with_everything) everything.run();
  }
  std::vector<RenderRow> rows{own.row(name, packing_seconds)};
  if (options.with_everything) rows.push_back(everything.row(name + ", everything in", packing_seconds));
  return rows;
}

}  // namespace facet::bench
