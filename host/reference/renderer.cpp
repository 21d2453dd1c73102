#include "reference/renderer.h"

#include <atomic>
#include <chrono>

#include "core/parallel.h"
#include "reference/crop.h"
#include "reference/tracer.h"

namespace facet::reference {

namespace {

/// Pixels that a thread takes at a time.
constexpr std::size_t pixels_at_a_time = 64;
/// Samples a pass at most, over all pixels: between passes progress is told.
constexpr std::uint64_t samples_per_pass = 1U << 18U;

template <typename Real>
class Pass {
 public:
  Pass(const World<Real>& world, const RenderSettings& settings, Film& film)
      : world_(world), settings_(settings), film_(film) {}

  void run(std::uint32_t first, std::uint32_t end) {
    parallel_for(film_.pixels.size(), pixels_at_a_time, [&](std::size_t begin, std::size_t stop) {
      RayCounts counts;
      std::uint64_t bad = 0;
      for (std::size_t i = begin; i < stop; ++i) {
        for (std::uint32_t sample = first; sample < end; ++sample) add_sample(i, sample, counts, bad);
      }
      closest_ += counts.closest;
      any_ += counts.any;
      bad_ += bad;
    });
  }

  void tell(RenderStatistics& s) const {
    s.closest_rays = closest_;
    s.any_rays = any_;
    s.bad_samples = bad_;
  }

 private:
  void add_sample(std::size_t pixel, std::uint32_t sample, RayCounts& counts, std::uint64_t& bad) {
    const CropSample at(world_.scene, settings_, pixel, sample);
    Unwatched unwatched;
    Tracer<Real, Unwatched> tracer(world_, at.id, unwatched);
    const Vec3<Real> radiance = tracer.radiance(at.x, at.y);
    counts.closest += tracer.counts().closest;
    counts.any += tracer.counts().any;
    if (!is_good(radiance)) {
      ++bad;
      return;
    }
    const Vec3<Real> value = radiance * world_.camera.filter_sample(at.id).weight;
    film_.pixels[pixel].add({value.x, value.y, value.z});
  }

  const World<Real>& world_;
  const RenderSettings& settings_;
  Film& film_;
  std::atomic<std::uint64_t> closest_{0};
  std::atomic<std::uint64_t> any_{0};
  std::atomic<std::uint64_t> bad_{0};
};

}  // namespace

template <typename Real>
Film render(const Scene& scene, const RenderSettings& settings, const ProgressCallback& progress,
            RenderStatistics& statistics) {
  const World<Real> world(scene, settings.sampling);
  Film film = blank_film(scene, settings);
  const auto start = std::chrono::steady_clock::now();
  const auto pixels = static_cast<std::uint64_t>(film.pixels.size());
  const std::uint64_t total = pixels * (settings.end_sample - settings.first_sample);
  Pass<Real> pass(world, settings, film);
  for (std::uint32_t sample = settings.first_sample; sample < settings.end_sample;) {
    const auto most = static_cast<std::uint32_t>(std::max<std::uint64_t>(1, samples_per_pass / pixels));
    const std::uint32_t end = sample + std::min(most, settings.end_sample - sample);
    pass.run(sample, end);
    statistics.samples += pixels * (end - sample);
    pass.tell(statistics);
    statistics.render_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!progress(static_cast<double>(statistics.samples) / static_cast<double>(total), statistics)) break;
    sample = end;
  }
  return film;
}

template <typename Real>
std::function<std::vector<vec3>(std::uint32_t)> sample_renderer(const Scene& scene,
                                                                const RenderSettings& settings) {
  const auto world = std::make_shared<const World<Real>>(scene, settings.sampling);
  return [world, settings](std::uint32_t sample) {
    const Crop& c = settings.crop;
    std::vector<vec3> radiances(static_cast<std::size_t>(c.x1 - c.x0) *
                                static_cast<std::size_t>(c.y1 - c.y0));
    parallel_for(radiances.size(), pixels_at_a_time, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const CropSample at(world->scene, settings, i, sample);
        Unwatched unwatched;
        radiances[i] = Tracer<Real, Unwatched>(*world, at.id, unwatched).radiance(at.x, at.y);
      }
    });
    return radiances;
  };
}

template Film render<float>(const Scene&, const RenderSettings&, const ProgressCallback&, RenderStatistics&);
template Film render<double>(const Scene&, const RenderSettings&, const ProgressCallback&, RenderStatistics&);

template std::function<std::vector<vec3>(std::uint32_t)> sample_renderer<float>(const Scene&,
                                                                                const RenderSettings&);
template std::function<std::vector<vec3>(std::uint32_t)> sample_renderer<double>(const Scene&,
                                                                                 const RenderSettings&);

}  // namespace facet::reference
