#include "reference/reference_backend.h"

#include <atomic>

#include "core/clock.h"
#include "core/parallel.h"
#include "reference/crop.h"
#include "reference/reference_bsdf_evaluator.h"
#include "reference/tracer.h"

namespace facet::reference {

namespace {

/// Pixels that a thread takes at a time.
constexpr std::size_t pixels_at_a_time = 64;
/// Samples a pass at most, over all pixels: between passes progress is told.
constexpr std::uint64_t samples_per_pass = 1U << 18U;

template <typename Real>
constexpr Precision precision_of = sizeof(Real) == sizeof(double) ? Precision::double_
                                                                  : Precision::float_;

template <typename Real>
class ReferenceRendering : public RecordedRendering {
 public:
  ReferenceRendering(const Backend& backend, ScenePtr scene, const RenderSettings& settings)
      : RecordedRendering(backend, "reference", precision_of<Real>, *scene, settings),
        scene_(std::move(scene)),
        settings_(settings),
        world_(*scene_, settings_),
        film_(blank_film(settings_)) {}

  void run(const ProgressCallback& progress) override {
    const auto start = std::chrono::steady_clock::now();
    const auto most = static_cast<std::uint32_t>(
        std::max<std::uint64_t>(1, samples_per_pass / film_.pixels.size()));
    for (std::uint32_t sample = settings_.samples.begin; sample < settings_.samples.end;) {
      const std::uint32_t end = sample + std::min(most, settings_.samples.end - sample);
      pass(sample, end, [](std::size_t /*pixel*/, const Vec3<Real>& /*radiance*/) {});
      statistics_.render_seconds = seconds_since(start);
      if (progress && !progress(static_cast<double>(statistics_.samples) /
                                    static_cast<double>(settings_.total_samples()),
                                statistics_))
        break;
      sample = end;
    }
  }

  std::vector<Radiance> sample(std::uint32_t index) override {
    std::vector<Radiance> radiances(film_.pixels.size());
    pass(index, index + 1, [&](std::size_t pixel, const Vec3<Real>& radiance) {
      const Vec3<float> r(radiance);
      radiances[pixel] = {r.x, r.y, r.z};
    });
    return radiances;
  }

  const RenderStatistics& statistics() const override { return statistics_; }

 private:
  Film sums() const override { return film_; }

  /// Adds samples [first, end) of every pixel to the film, and shows each to `look`.
  template <typename Look>
  void pass(std::uint32_t first, std::uint32_t end, const Look& look) {
    std::atomic<std::uint64_t> closest{0};
    std::atomic<std::uint64_t> any{0};
    std::atomic<std::uint64_t> bad{0};
    parallel_for(film_.pixels.size(), pixels_at_a_time, [&](std::size_t begin, std::size_t stop) {
      RayCounts counts;
      std::uint64_t dropped = 0;
      for (std::size_t i = begin; i < stop; ++i) {
        for (std::uint32_t sample = first; sample < end; ++sample) {
          const CropSample at(settings_, i, sample);
          Unwatched unwatched;
          Tracer<Real, Unwatched> tracer(world_, at.id, unwatched);
          const Vec3<Real> radiance = tracer.radiance(at.x, at.y);
          counts.closest += tracer.counts().closest;
          counts.any += tracer.counts().any;
          look(i, radiance);
          if (!is_good(radiance)) {
            ++dropped;
            continue;
          }
          const Vec3<Real> value = radiance * world_.camera.filter_sample(at.id).weight;
          film_.pixels[i].add({value.x, value.y, value.z});
        }
      }
      closest += counts.closest;
      any += counts.any;
      bad += dropped;
    });
    statistics_.closest_rays += closest;
    statistics_.any_rays += any;
    statistics_.bad_samples += bad;
    statistics_.samples += film_.pixels.size() * std::uint64_t{end - first};
  }

  ScenePtr scene_;
  RenderSettings settings_;
  World<Real> world_;
  Film film_;
  RenderStatistics statistics_;
};

template <typename Real>
class ReferenceBackend : public TestableBackend {
 public:
  std::string name() const override {
    return precision_of<Real> == Precision::double_ ? "CPU reference in double"
                                                    : "CPU reference in float";
  }
  std::string driver() const override { return "none"; }

  std::unique_ptr<Rendering> start(const ScenePtr& scene, const RenderSettings& settings) override {
    return std::make_unique<ReferenceRendering<Real>>(*this, scene, settings);
  }

  std::unique_ptr<statistics::BsdfEvaluator> evaluator(const Bsdf& bsdf,
                                                       LobeSampling sampling) override {
    return std::make_unique<ReferenceBsdfEvaluator<Real>>(bsdf, sampling);
  }
};

}  // namespace

std::unique_ptr<TestableBackend> make_backend(Precision precision) {
  if (precision == Precision::double_) return std::make_unique<ReferenceBackend<double>>();
  return std::make_unique<ReferenceBackend<float>>();
}

}  // namespace facet::reference
