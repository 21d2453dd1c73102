#include "tradeoff/tradeoff.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "statistics/hypothesis.h"
#include "tradeoff/laboratory.h"
#include "tradeoff/series.h"

namespace facet::tradeoff {

namespace {

constexpr std::uint32_t least_seeds = 4;
/// Probability that any of so many settings without bias is said to have one.
constexpr double significance = 0.01;
constexpr std::uint64_t tested_settings = 100;

/// A setting with its renders.
struct Trial {
  Setting setting;
  Candidate candidate;
  std::vector<Series> series;  ///< by samples, ascending
};

class Study {
 public:
  Study(Backend& kernels, ScenePtr scene, const Options& options, const Callback& callback)
      : scene_(std::move(scene)),
        options_(options),
        laboratory_(kernels, scene_, options, callback) {
    result_.device = kernels.name();
    result_.driver = kernels.driver();
  }

  Tradeoff run() {
    try {
      measure_first();
      if (!options_.exhaustive) climb();
      if (options_.pictures) take_pictures();
    } catch (const Interrupted&) {
      if (trials_.empty()) throw;
      result_.interrupted = true;
    }
    return conclude();
  }

 private:
  Trial new_trial(const Candidate& candidate) const {
    Trial trial;
    trial.candidate = candidate;
    trial.setting.plan = candidate.plan;
    trial.setting.options = candidate.options;
    trial.setting.name = name_of(*scene_, candidate.plan, laboratory_.base());
    for (const std::uint32_t n : laboratory_.ladder(candidate.plan)) {
      Series& series = trial.series.emplace_back();
      series.samples = n;
    }
    return trial;
  }

  std::vector<Trial> new_trials(const std::vector<Candidate>& candidates) const {
    std::vector<Trial> trials;
    for (const Candidate& candidate : candidates) {
      // Adaptive sampling has a least number of samples.
      if (!laboratory_.ladder(candidate.plan).empty()) trials.push_back(new_trial(candidate));
    }
    return trials;
  }

  /// One more render of each series, and of the default beside them: numbers of samples one after
  /// the other, so that settings that are compared take turns.
  void render_round(std::vector<Trial>& trials, std::uint32_t seed) {
    struct Result {
      Series* series;
      Film film;
      double default_seconds;
    };
    std::vector<Result> results;
    const bool holds_default = trials.front().setting.options == default_options();
    for (const std::uint32_t n : laboratory_.ladder()) {
      double default_seconds = 0;
      if (!holds_default)
        default_seconds = laboratory_.render(laboratory_.base(), n, seed).record.seconds;
      for (Trial& trial : trials) {
        for (Series& series : trial.series) {
          if (series.samples != n) continue;
          Film film = laboratory_.render(trial.candidate.plan, n, seed);
          if (holds_default && &trial == trials.data()) default_seconds = film.record.seconds;
          results.push_back({&series, std::move(film), default_seconds});
        }
      }
    }
    // A round that is interrupted counts for none.
    for (const Result& result : results)
      add(*result.series, result.film, result.default_seconds, laboratory_.reference());
  }

  [[nodiscard]] const std::vector<std::string>& default_options() const {
    return laboratory_.first().front().options;
  }

  void measure_first() {
    std::vector<Trial> trials = new_trials(laboratory_.first());
    const double until = options_.exhaustive ? climbing_until : alone_until;
    const double expected = laboratory_.expected_seconds(least_seeds);
    if (expected > laboratory_.seconds_until(1))
      laboratory_.tell(fmt::format("{} settings take about {:.0f} s, beyond the budget",
                                   trials.size(), expected));
    double round_seconds = 0;
    try {
      while (seeds_ < least_seeds || laboratory_.seconds_until(until) > round_seconds) {
        laboratory_.tell(fmt::format("{} settings, round {}", trials.size(), seeds_ + 1));
        const double before = laboratory_.seconds_until(1);
        render_round(trials, seeds_);
        round_seconds = before - laboratory_.seconds_until(1);
        ++seeds_;
      }
    } catch (const Interrupted&) {
      if (seeds_ < 2) throw;
      keep(std::move(trials));
      throw;
    }
    keep(std::move(trials));
  }

  void measure(const std::vector<Candidate>& candidates) {
    std::vector<Trial> trials = new_trials(candidates);
    if (trials.empty()) return;
    for (std::uint32_t seed = 0; seed < seeds_; ++seed) {
      laboratory_.tell(fmt::format("{} combinations, round {}", trials.size(), seed + 1));
      render_round(trials, seed);
    }
    keep(std::move(trials));
  }

  void keep(std::vector<Trial> trials) {
    for (Trial& trial : trials) {
      trials_.push_back(std::move(trial));
      evaluate(trials_.back());
    }
    for (const std::uint32_t n : laboratory_.ladder()) {
      std::vector<Point*> points;
      for (Trial& trial : trials_) {
        for (Point& p : trial.setting.points) {
          if (p.samples == n) points.push_back(&p);
        }
      }
      expect(points);
    }
  }

  [[nodiscard]] const Series& default_series(std::uint32_t samples) const {
    return *std::ranges::find(trials_.front().series, samples, &Series::samples);
  }

  void evaluate(Trial& trial) {
    Setting& setting = trial.setting;
    Reference& reference = laboratory_.reference();
    for (const Series& series : trial.series)
      setting.points.push_back(
          point_of(series, default_series(series.samples), reference.relmse()));
    setting.slope = slope_of(setting.points);
    Series& last = trial.series.back();
    if (trial.candidate.biased) {
      setting.biased = true;
      setting.bias = measure_bias(last.images, default_series(last.samples).images, reference);
    } else {
      // Where light is so rare that an image's variance tells nothing of it, it looks biased to the
      // test, but the images' own scatter explains the difference.
      const double bias = measure_bias(last.images, reference);
      setting.biased =
          bias > 0 && is_biased(last.sum, reference,
                                statistics::sidak_significance(significance, tested_settings));
      if (setting.biased) setting.bias = bias;
    }
  }

  /// Of the unbiased settings with the most samples.
  [[nodiscard]] std::size_t best() const {
    std::size_t best = 0;
    for (std::size_t i = 0; i < trials_.size(); ++i) {
      const Setting& setting = trials_[i].setting;
      const Point& p = setting.last();
      if (!setting.biased && p.samples == laboratory_.ladder().back() &&
          p.expected_ratio > trials_[best].setting.last().expected_ratio)
        best = i;
    }
    return best;
  }

  [[nodiscard]] bool is_measured(const Candidate& candidate) const {
    return std::ranges::any_of(
        trials_, [&](const Trial& trial) { return trial.setting.options == candidate.options; });
  }

  /// The best choice of each kind, where it gains anything.
  [[nodiscard]] std::vector<Candidate> winners() const {
    std::map<std::string, const Trial*> best;
    for (const Trial& trial : trials_) {
      if (trial.setting.biased || trial.candidate.kind.empty()) continue;
      const double ratio = trial.setting.last().expected_ratio;
      if (ratio <= 1) continue;
      const Trial*& known = best[trial.candidate.kind];
      if (known == nullptr || ratio > known->setting.last().expected_ratio) known = &trial;
    }
    std::vector<Candidate> candidates;
    candidates.reserve(best.size());
    for (const auto& [kind, trial] : best) candidates.push_back(trial->candidate);
    return candidates;
  }

  /// From the best choices together to whatever is better, one choice at a time.
  void climb() {
    Candidate together;
    together.plan = combine(*scene_, laboratory_.base(), winners());
    together.options = options_of(*scene_, together.plan);
    if (!is_measured(together)) measure({together});
    for (std::size_t from = best();; from = best()) {
      std::vector<Candidate> candidates;
      for (Candidate& next :
           candidates_around(*scene_, trials_[from].candidate.plan, laboratory_.base(), false)) {
        next.kind.clear();
        if (!is_measured(next)) candidates.push_back(std::move(next));
      }
      if (candidates.empty() || !is_affordable(candidates.size())) return;
      measure(candidates);
      if (best() == from) return;
    }
  }

  [[nodiscard]] bool is_affordable(std::size_t settings) const {
    double seconds = 0;
    for (const Series& series : trials_.front().series)
      seconds += series.seconds.front() * seeds_ * static_cast<double>(settings + 1);
    return seconds < laboratory_.seconds_until(climbing_until);
  }

  /// Each choice alone, and the best.
  void take_pictures() {
    laboratory_.tell("images at equal time");
    const double seconds = trials_.front().setting.last().seconds;
    const std::size_t best_one = best();
    for (std::size_t i = 0; i < trials_.size(); ++i) {
      const Candidate& candidate = trials_[i].candidate;
      Setting& setting = trials_[i].setting;
      if (i != 0 && i != best_one && candidate.kind.empty()) continue;
      const Point& p = setting.last();
      const double least = candidate.plan.request.adaptive ? least_adaptive_samples : 1;
      const double wanted = std::max(least, std::round(p.samples * seconds / p.seconds));
      const auto samples = static_cast<std::uint32_t>(std::min(wanted, 0x1p30));
      const Film film = laboratory_.render(candidate.plan, samples, 0);
      Image image = develop(film, false);
      const RelativeError error = relative_error(image, laboratory_.reference());
      setting.picture = {std::move(image), samples, film.record.seconds, error};
    }
  }

  Tradeoff conclude() {
    result_.scene = scene_->file.string();
    result_.own_size = laboratory_.own_size();
    result_.size = laboratory_.size();
    result_.seeds = seeds_;
    result_.startup_seconds = laboratory_.startup_seconds();
    result_.bound_hits = laboratory_.bound_hits();
    result_.best = best();
    for (Trial& trial : trials_) result_.settings.push_back(std::move(trial.setting));
    result_.reference = std::move(laboratory_.reference());
    mark_front(result_.settings);
    return std::move(result_);
  }

  ScenePtr scene_;
  const Options& options_;
  Laboratory laboratory_;
  std::uint32_t seeds_ = 0;
  std::vector<Trial> trials_;  ///< the default first
  Tradeoff result_;
};

}  // namespace

std::optional<Tradeoff> measure(Backend& kernels, const ScenePtr& scene, const Options& options,
                                const Callback& callback) {
  try {
    return Study(kernels, scene, options, callback).run();
  } catch (const Interrupted&) {
    return std::nullopt;
  }
}

}  // namespace facet::tradeoff
