#include "bench/whole_render.h"

#include <numeric>

#include "core/clock.h"
#include "render/renderer.h"

namespace facet::bench {

RenderRow measure_render(gpu::Device& device, const std::string& name, const Scene& scene,
                         std::uint32_t samples_per_pixel, int repeats) {
  RenderRow row;
  row.scene = name;
  row.integrator = scene.integrator.type.name;
  row.samples_per_pixel = samples_per_pixel;
  RenderSettings settings;
  settings.crop = {0, 0, scene.camera.width, scene.camera.height};
  settings.seed = scene.seed;
  settings.end_sample = samples_per_pixel;
  settings.time_stages = true;
  const auto start = std::chrono::steady_clock::now();
  const PackedScene packed = pack_scene(scene);
  const Features features = find_features(scene, settings);
  std::vector<double> rates;
  RenderStatistics last;
  for (int run = 0; run < repeats; ++run) {
    Renderer renderer(device, packed, features, settings);
    if (run == 0) {
      row.startup_seconds = seconds_since(start);
      row.compile_seconds = renderer.statistics().compile_seconds;
      row.device_bytes = renderer.statistics().device_bytes;
    }
    renderer.render([](double /*done*/, const RenderStatistics& /*so_far*/) { return true; });
    last = renderer.statistics();
    rates.push_back(static_cast<double>(last.samples) / last.render_seconds);
  }
  row.samples_per_second = summarise(rates);
  const double rays = static_cast<double>(last.closest_rays + last.any_rays);
  row.rays_per_second = row.samples_per_second.median * rays / static_cast<double>(last.samples);
  const double total = std::accumulate(last.stage_seconds.begin(), last.stage_seconds.end(), 0.0);
  for (std::size_t i = 0; i < row.stage_shares.size(); ++i)
    row.stage_shares[i] = total > 0 ? last.stage_seconds[i] / total : 0;
  return row;
}

}  // namespace facet::bench
