#include "tradeoff/laboratory.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "compare/metrics.h"
#include "core/clock.h"
#include "core/error.h"

namespace facet::tradeoff {

namespace {

/// Renders of a point that images are made small enough for.
constexpr std::uint32_t planned_seeds = 5;
/// How much longer than the default settings take on average, at most.
constexpr double planned_slowness = 1.3;
/// Samples of the reference for each of the largest number that is measured, likewise.
constexpr double planned_reference = 64;
/// Those it has at least, whatever the budget.
constexpr std::uint32_t least_reference = 16;
constexpr int least_pixels = 1024;

/// The base and what choices lead to from it: one choice, or, where `all`, unbiased ones one after
/// the other.
std::vector<Candidate> candidates_from(const Scene& scene, const Plan& base, bool all) {
  std::vector<Candidate> known{{base, options_of(scene, base), "", false, {}}};
  for (std::size_t i = 0; i < (all ? known.size() : 1); ++i) {
    if (known[i].biased) continue;
    for (Candidate& next : candidates_around(scene, known[i].plan, base, i == 0)) {
      const bool is_new = std::ranges::none_of(
          known, [&](const Candidate& k) { return k.options == next.options; });
      if (i > 0) next.kind.clear();
      if (is_new) known.push_back(std::move(next));
    }
  }
  return known;
}

}  // namespace

Laboratory::Laboratory(Backend& kernels, ScenePtr scene, const Options& options,
                       const Callback& callback)
    : kernels_(kernels), scene_(std::move(scene)), options_(options), callback_(callback) {
  base_.request = options.base;
  base_.request.samples.reset();
  const RenderSettings settings = settings_of(*scene_, base_);
  seed_ = settings.seed;
  own_size_ = size_ = settings.size;
  const std::uint32_t most = options.base.samples
                                 ? static_cast<std::uint32_t>(*options.base.samples)
                                 : default_most_samples;
  ladder_ = ladder_to(most);
  if (ladder_.empty())
    throw InputError(fmt::format("{} samples a pixel: adaptive sampling needs at least {}", most,
                                 least_adaptive_samples));
  first_ = candidates_from(*scene_, base_, options.exhaustive);
  if (!options.reference.empty()) take_reference();
  tell("trying");
  const bool is_free = !options.base.size && !options.base.crop && options.reference.empty();
  const ImageSize wanted = size_;
  // A crop is told in pixels of the wanted size.
  if (!options.base.crop) size_ = shrunk(least_pixels);
  // Later ones need not compile any more.
  const auto start = std::chrono::steady_clock::now();
  const Film trial = render(base_, ladder_.front(), 0);
  startup_seconds_ = seconds_since(start) - trial.record.seconds;
  rate_ = static_cast<double>(trial.pixels.size()) * ladder_.front() / trial.record.seconds;
  if (!options.base.crop) measure_rate();
  size_ = is_free ? shrunk(std::max<double>(least_pixels, affordable_pixels())) : wanted;
  const bool fewer_will_do = !is_free && !options.base.samples;
  while (fewer_will_do && ladder_.back() / 2 >= least_adaptive_samples &&
         affordable_pixels() < pixels())
    ladder_ = ladder_to(ladder_.back() / 2);
  if (options.reference.empty()) find_reference();
}

std::vector<std::uint32_t> Laboratory::ladder_to(std::uint32_t most) const {
  std::vector<std::uint32_t> counts;
  for (const std::uint32_t n : {most / 16, most / 4, most}) {
    if (n >= (base_.request.adaptive ? least_adaptive_samples : 1)) counts.push_back(n);
  }
  return counts;
}

std::vector<std::uint32_t> Laboratory::ladder(const Plan& plan) const {
  // The reference is slow, and it is precision that is asked of it.
  if (plan.reference) return {ladder_.front()};
  std::vector<std::uint32_t> counts;
  for (const std::uint32_t n : ladder_) {
    if (!plan.request.adaptive || n >= least_adaptive_samples) counts.push_back(n);
  }
  return counts;
}

double Laboratory::seconds_until(double share) const {
  return share * options_.budget - seconds_since(start_);
}

bool Laboratory::go_on() const {
  return callback_(std::clamp(seconds_since(start_) / options_.budget, 0.0, 1.0), what_);
}

void Laboratory::tell(const std::string& what) {
  what_ = what;
  if (!go_on()) throw Interrupted();
}

Backend& Laboratory::backend_of(const Plan& plan) {
  if (!plan.reference) return kernels_;
  std::unique_ptr<Backend>& backend = references_[*plan.reference];
  if (!backend) backend = open_backend({.reference = plan.reference});
  return *backend;
}

Film Laboratory::render(const Plan& plan, RenderRequest request) {
  request.size = size_;
  request.variance = true;
  const std::unique_ptr<Rendering> rendering = backend_of(plan).start(scene_, request);
  bool goes_on = true;
  rendering->run([&](double, const RenderStatistics&) { return goes_on = go_on(); });
  if (!goes_on) throw Interrupted();
  bound_hits_ += rendering->statistics().bound_hits;
  return rendering->film();
}

Film Laboratory::render(const Plan& plan, std::uint32_t samples, std::uint32_t seed) {
  RenderRequest request = plan.request;
  request.samples = static_cast<int>(samples);
  request.seed = seed_ + seed;
  return render(plan, std::move(request));
}

void Laboratory::take_reference() {
  reference_ = read_reference(options_.reference);
  const ImageWindow& window = reference_.image.window;
  if (!options_.base.size) size_ = {window.full_width, window.full_height};
  Plan sized = base_;
  sized.request.size = size_;
  const RenderSettings settings = settings_of(*scene_, sized);
  Image rendered(settings.crop_width(), settings.crop_height(), {"R", "G", "B"});
  rendered.window = settings.window();
  check_comparable(rendered, "the render", reference_.image, options_.reference);
}

void Laboratory::measure_rate() {
  constexpr std::uint32_t samples_of_trial = least_adaptive_samples;
  constexpr double most_of_budget = 0.02;
  const ImageSize size = size_;
  // A fast device is at its best with many paths at a time, for which a slow one takes too long.
  for (const double pixels_of_trial : {0x1p14, 0x1p20}) {
    size_ = shrunk(pixels_of_trial);
    const double samples = pixels() * samples_of_trial;
    if (pixels_of_trial > 0x1p14 && samples / rate_ > most_of_budget * options_.budget) break;
    // The first one warms up.
    (void)render(base_, samples_of_trial, 0);
    rate_ = samples / render(base_, samples_of_trial, 0).record.seconds;
  }
  size_ = size;
}

double Laboratory::affordable_pixels() const {
  const double left = options_.budget - seconds_since(start_) -
                      startup_seconds_ * static_cast<double>(first_.size());
  const double for_reference =
      reference_until * left * rate_ / (planned_reference * ladder_.back());
  const double share = options_.reference.empty() ? alone_until - reference_until : alone_until;
  const double for_settings =
      share * left * rate_ / (planned_seeds * planned_slowness * samples_of_round());
  return options_.reference.empty() ? std::min(for_reference, for_settings) : for_settings;
}

double Laboratory::pixels() const {
  Plan sized = base_;
  sized.request.size = size_;
  const RenderSettings settings = settings_of(*scene_, sized);
  return static_cast<double>(settings.crop_width()) * settings.crop_height();
}

double Laboratory::samples_of_round() const {
  double samples = 0;
  for (const Candidate& candidate : first_) {
    const std::vector<std::uint32_t> counts = ladder(candidate.plan);
    samples += std::accumulate(counts.begin(), counts.end(), 0.0);
  }
  return samples;
}

double Laboratory::expected_seconds(std::uint32_t rounds) const {
  const double samples = pixels() * samples_of_round();
  return startup_seconds_ * static_cast<double>(first_.size()) +
         rounds * planned_slowness * samples / rate_;
}

ImageSize Laboratory::shrunk(double pixels) const {
  const double factor =
      std::sqrt(pixels / (static_cast<double>(own_size_.width) * own_size_.height));
  if (factor >= 1) return own_size_;
  const auto scaled = [&](int n) { return std::max(1, static_cast<int>(std::lround(factor * n))); };
  return {scaled(own_size_.width), scaled(own_size_.height)};
}

void Laboratory::find_reference() {
  tell("rendering the reference");
  const Plan plan = reference_plan(*scene_, base_);
  RenderRequest request = plan.request;
  // None of the seeds that are measured with.
  request.seed = seed_ ^ 0x9e3779b9U;
  request.estimate_error = true;
  const std::uint32_t enough = least_reference * ladder_.back();
  // What settings need goes before digits of the reference.
  const double seconds = std::min(seconds_until(reference_until),
                                  seconds_until(climbing_until) - expected_seconds(planned_seeds));
  if (planned_slowness * pixels() * enough / rate_ < seconds) {
    using std::chrono::steady_clock;
    request.deadline = steady_clock::now() + std::chrono::duration_cast<steady_clock::duration>(
                                                 std::chrono::duration<double>(seconds));
  } else {
    request.samples = static_cast<int>(enough);
  }
  Film film = render(plan, request);
  if (film.record.samples.count() < enough) {
    request.deadline.reset();
    request.samples = static_cast<int>(enough);
    film = render(plan, std::move(request));
  }
  reference_ = make_reference(film);
}

}  // namespace facet::tradeoff
