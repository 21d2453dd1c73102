#include "reference/reference_backend.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <stdexcept>

#include "convergence/sampling_plan.h"
#include "core/clock.h"
#include "core/parallel.h"
#include "image/film_words.h"
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
class ReferenceRendering : public RecordedRendering, private SampleSource {
 public:
  ReferenceRendering(const Backend& backend, ScenePtr scene, const RenderSettings& settings)
      : RecordedRendering(backend, "reference", precision_of<Real>, *scene, settings),
        scene_(std::move(scene)),
        settings_(settings),
        world_(*scene_, settings_),
        plan_(settings_.goal()),
        films_{blank_film(settings_),
               settings_.goal().has_trial() ? blank_film(settings_) : Film()} {
    statistics_.planned = settings_.total_samples();
  }

  void run(const ProgressCallback& progress) override {
    // Seconds of those who rendered before are counted as well.
    start_ = Clock::now() - duration_of(statistics_.render_seconds);
    progress_ = progress;
    note(plan_.run(*this));
  }

  std::vector<Radiance> sample(std::uint32_t index) override {
    std::vector<Radiance> radiances(image().pixels.size());
    pass(image(), all_pixels(), settings_.seed, {index, index + 1},
         [&](std::size_t pixel, const Vec3<Real>& radiance) {
           const Vec3<float> r(radiance);
           radiances[pixel] = {r.x, r.y, r.z};
         });
    return radiances;
  }

  Film film() const override {
    Film film = film_of(settings_.goal(), *this);
    film.record = record();
    return film;
  }
  const RenderStatistics& statistics() const override { return statistics_; }

  RenderState state() const override {
    RenderState state = state_of(plan_, settings_.goal());
    state.film = films_.front();
    state.film.record = record_so_far(plan_);
    state.image = words_of(films_.front().pixels);
    if (settings_.goal().has_trial()) state.trial = words_of(films_.back().pixels);
    state.statistics = statistics_;
    return state;
  }
  bool is_good_moment() const override { return plan_.is_good_moment(); }
  void restore(const RenderState& state) override {
    plan_.restore(state.plan);
    set_sums(films_.front(), state.image);
    if (settings_.goal().has_trial()) set_sums(films_.back(), state.trial);
    add_counts(statistics_, state.statistics);
  }

 private:
  [[nodiscard]] Film& image() { return films_.front(); }

  [[nodiscard]] PixelList all_pixels() const {
    PixelList pixels(films_.front().pixels.size());
    std::iota(pixels.begin(), pixels.end(), 0U);
    return pixels;
  }

  bool add(const SamplingTask& task, std::uint32_t& next) override {
    Film& film = films_.at(static_cast<std::size_t>(task.sums));
    const PixelList all = task.pixels.empty() ? all_pixels() : PixelList();
    const PixelList& pixels = task.pixels.empty() ? all : task.pixels;
    const auto most = static_cast<std::uint32_t>(std::max<std::uint64_t>(
        1, samples_per_pass / std::uint64_t{task.samples.end - task.samples.begin}));
    while (next < pixels.size()) {
      const std::size_t end = std::min<std::size_t>(pixels.size(), std::size_t{next} + most);
      const PixelList some(pixels.begin() + next,
                           pixels.begin() + static_cast<std::ptrdiff_t>(end));
      pass(film, some, task.seed, task.samples,
           [](std::size_t /*pixel*/, const Vec3<Real>& /*radiance*/) {});
      next = static_cast<std::uint32_t>(end);
      if (!tell()) return false;
    }
    return true;
  }
  Film sums(Sums of) const override { return films_.at(static_cast<std::size_t>(of)); }
  void clear(Sums which) override {
    films_.at(static_cast<std::size_t>(which)) = blank_film(settings_);
  }
  void expect(double samples) override {
    statistics_.planned = std::max(statistics_.samples, static_cast<std::uint64_t>(samples));
  }

  static void set_sums(Film& film, const std::vector<WordPlane>& words) {
    std::vector<PixelSums> pixels = sums_of(words);
    if (pixels.size() != film.pixels.size()) throw std::invalid_argument("words of another film");
    film.pixels = std::move(pixels);
  }

  /// Calls the progress; returns whether to go on.
  bool tell() {
    statistics_.render_seconds = seconds_since(start_);
    const double done =
        static_cast<double>(statistics_.samples) / static_cast<double>(statistics_.planned);
    return !progress_ || progress_(std::min(done, 1.0), statistics_);
  }

  /// Adds samples of some pixels to a film, and shows each to `look`.
  template <typename Look>
  void pass(Film& film, const PixelList& pixels, std::uint32_t seed, const SampleRange& samples,
            const Look& look) {
    RenderSettings settings = settings_;
    settings.seed = seed;
    std::atomic<std::uint64_t> closest{0};
    std::atomic<std::uint64_t> any{0};
    std::atomic<std::uint64_t> bad{0};
    parallel_for(pixels.size(), pixels_at_a_time, [&](std::size_t begin, std::size_t stop) {
      RayCounts counts;
      std::uint64_t dropped = 0;
      for (std::size_t k = begin; k < stop; ++k) {
        const std::size_t i = pixels[k];
        for (std::uint32_t sample = samples.begin; sample < samples.end; ++sample) {
          const CropSample at(settings, i, sample);
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
          film.pixels[i].add({value.x, value.y, value.z});
        }
      }
      closest += counts.closest;
      any += counts.any;
      bad += dropped;
    });
    statistics_.closest_rays += closest;
    statistics_.any_rays += any;
    statistics_.bad_samples += bad;
    statistics_.samples += pixels.size() * std::uint64_t{samples.end - samples.begin};
  }

  ScenePtr scene_;
  RenderSettings settings_;
  World<Real> world_;
  SamplingPlan plan_;
  std::array<Film, 2> films_;  ///< the image's sums, and the trial's
  ProgressCallback progress_;
  RenderStatistics statistics_;
  std::chrono::steady_clock::time_point start_;
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
