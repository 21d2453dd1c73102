#include "convergence/sampling_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "convergence/allocation.h"
#include "convergence/probes.h"

namespace facet {

namespace {

using Sums = SampleSource::Sums;

// Numbers of other samples than the image's.
constexpr std::uint32_t pilot_seed = 0x9e3779b9U;
constexpr std::uint32_t probe_seed = 0x85ebca6bU;

/// Fewest samples a pixel whose error is estimated.
constexpr std::uint32_t least_estimated = 16;

/// Of one look at the error: whoever looks several times, as at a goal of 95 %, errs more often.
constexpr double confidence = 0.99;

/// Samples of a pilot where nobody knows how many will follow.
constexpr std::uint32_t open_ended_pilot = 16;

std::uint32_t seed_of_probes(const SamplingGoal& goal) { return goal.seed ^ probe_seed; }

PixelList probes_of(const SamplingGoal& goal) {
  if (!goal.probes) return {};
  return choose_probes(goal.width, goal.height, seed_of_probes(goal));
}

/// How long samples take, and how long there is.
class Pace {
 public:
  Pace(const SamplingGoal& goal, const SampleSource& source)
      : deadline_(goal.deadline), source_(source), last_(source.now()) {}

  /// So many more samples a pixel have been rendered since the last call.
  void note(std::uint32_t samples) {
    const Clock::time_point now = source_.now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    all_seconds_ += seconds;
    all_samples_ += samples;
    const double average = all_seconds_ / all_samples_;
    slowest_ = std::max(seconds / samples, average);
  }
  [[nodiscard]] bool is_limited() const { return deadline_.has_value(); }
  [[nodiscard]] double seconds_left() const {
    return std::chrono::duration<double>(*deadline_ - source_.now()).count();
  }
  /// Samples a pixel that will be done by the deadline, surely, as far as the past tells.
  [[nodiscard]] std::uint32_t fitting(double share = 1) const {
    constexpr double reserve = 0.9;
    if (all_samples_ == 0) return 0;
    const double samples = reserve * share * seconds_left() / slowest_;
    return static_cast<std::uint32_t>(std::clamp(samples, 0.0, 0x1p30));
  }

 private:
  std::optional<Clock::time_point> deadline_;
  const SampleSource& source_;
  Clock::time_point last_;
  double all_seconds_ = 0;
  double all_samples_ = 0;
  double slowest_ = 0;  ///< seconds a sample, of late or on average
};

/// One render.
class Sampling {
 public:
  Sampling(const SamplingGoal& goal, SampleSource& source)
      : goal_(goal),
        source_(source),
        probes_(probes_of(goal)),
        most_(goal.samples.end - goal.samples.begin),
        pace_(goal, source) {}

  SamplingOutcome run() {
    expect(most_);
    if (goal_.adaptive && !run_pilot()) return outcome(StoppedBy::interrupt);
    for (;;) {
      const std::uint32_t more = next_round();
      if (more == 0) return outcome(done_ == most_ ? StoppedBy::samples : StoppedBy::time);
      if (!advance(more)) return outcome(StoppedBy::interrupt);
      pace_.note(more);
      if (is_good_enough()) return outcome(StoppedBy::error);
    }
  }

 private:
  /// Samples a pixel of the next round: 1, 1, 2, 4, ..., which give an early picture of the whole;
  /// fewer where a goal is near.
  std::uint32_t next_round() {
    std::uint32_t more = std::max(done_, 1U);
    if (allocation_ && done_ == 0) more = goal_.open_ended() ? open_ended_pilot : most_;
    more = std::min(more, most_ - done_);
    if (wanted_ > 0) {
      const double wanted = std::ceil(wanted_) - done_;
      more = std::min(more, static_cast<std::uint32_t>(std::clamp(wanted, 1.0, 0x1p30)));
    }
    if (pace_.is_limited()) {
      const std::uint32_t fitting = pace_.fitting();
      more = std::min(more, done_ == 0 ? std::max(fitting, allocation_ ? 2U : 1U) : fitting);
    }
    tell_expectations();
    return more;
  }

  /// Adds samples of every pixel, on average.
  bool advance(std::uint32_t more) {
    const std::uint32_t end = done_ + more;
    if (allocation_) {
      if (!advance_by_allocation(end)) return false;
    } else {
      const std::uint32_t begin = goal_.samples.begin;
      const SampleRange samples{begin + done_, begin + end};
      if (!source_.add(Sums::image, nullptr, samples, goal_.seed)) return false;
      if (!probes_.empty() && !source_.add(Sums::trial, &probes_, samples, seed_of_probes(goal_)))
        return false;
    }
    done_ = end;
    return true;
  }

  bool advance_by_allocation(std::uint32_t mean) {
    const std::uint32_t budget = goal_.open_ended() ? mean : mean - pilot_samples(mean);
    std::vector<std::uint32_t> counts = allocation_->counts(mean, budget);
    if (counts_.empty()) {
      counts_.assign(counts.size(), 0);
      least_ = smallest_allocation(mean);
    }
    // A larger budget may have other bounds; what a pixel has, it keeps.
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = std::max(counts[i], counts_[i]);
    PixelList all(counts.size());
    std::iota(all.begin(), all.end(), 0U);
    if (!fill(Sums::image, std::move(all), counts, goal_.seed)) return false;
    if (!probes_.empty() && !fill(Sums::trial, probes_, counts, seed_of_probes(goal_)))
      return false;
    counts_ = std::move(counts);
    return true;
  }

  /// Adds samples of these pixels, from the numbers that they have to others: twice as many from
  /// step to step, of ever fewer.
  bool fill(Sums sums, PixelList pixels, const std::vector<std::uint32_t>& counts,
            std::uint32_t seed) {
    std::uint32_t begin = 0;
    for (std::uint32_t end = least_;; begin = end, end *= 2) {
      std::erase_if(pixels, [&](std::uint32_t p) { return counts[p] < end; });
      if (pixels.empty()) return true;
      PixelList lacking;
      std::copy_if(pixels.begin(), pixels.end(), std::back_inserter(lacking),
                   [&](std::uint32_t p) { return counts_[p] < end; });
      if (!lacking.empty() && !source_.add(sums, &lacking, {begin, end}, seed)) return false;
    }
  }

  /// Renders the pilot and throws it away; returns whether to go on.
  bool run_pilot() {
    if (pace_.is_limited() && !(pace_.seconds_left() > 0)) return true;
    const std::uint32_t seed = goal_.seed ^ pilot_seed;
    std::uint32_t samples = goal_.open_ended() ? open_ended_pilot : pilot_samples(most_);
    std::uint32_t begin = 0;
    if (pace_.is_limited()) {
      begin = 1;
      if (!source_.add(Sums::trial, nullptr, {0, begin}, seed)) return false;
      pace_.note(begin);
      samples = std::min(samples, std::bit_floor(pace_.fitting(0.125) + begin));
    }
    // In the shortest of times a pilot would take what the image needs.
    if (samples >= 4) {
      const std::uint32_t half = samples / 2;
      if (begin < half && !source_.add(Sums::trial, nullptr, {begin, half}, seed)) return false;
      const Film first_half = source_.sums(Sums::trial);
      if (!source_.add(Sums::trial, nullptr, {half, samples}, seed)) return false;
      pace_.note(samples - begin);
      allocation_.emplace(first_half, source_.sums(Sums::trial));
    }
    if (goal_.open_ended()) spent_ = allocation_ ? samples : begin;
    source_.clear(Sums::trial);
    return true;
  }

  /// Looks at the error, where it matters, and at how many samples it would take.
  bool is_good_enough() {
    if (!goal_.error || (done_ < least_estimated && done_ < most_)) return false;
    const ErrorEstimate estimate = estimate_error(film_of(goal_, source_));
    const double excess = estimate.relative_upper(confidence) / *goal_.error;
    // An image without light or noise has an error of 0.
    if (excess <= 1) return true;
    // The error of samples in an order falls faster than that of independent ones. Better look
    // again than render too much, but not for the sake of a few.
    const double power = probes_.empty() ? 2.0 : 4.0 / 3.0;
    wanted_ = done_ * std::max(std::pow(excess, power), 1.05);
    return false;
  }

  void tell_expectations() {
    double samples = most_;
    if (wanted_ > 0) samples = std::min(samples, wanted_);
    if (pace_.is_limited())
      samples = std::min(samples, static_cast<double>(done_) + pace_.fitting());
    expect(samples);
  }

  /// samples: of the image, a pixel.
  void expect(double samples) {
    const double pixels = static_cast<double>(goal_.width) * goal_.height;
    source_.expect((samples + spent_) * pixels + samples * static_cast<double>(probes_.size()));
  }

  [[nodiscard]] SamplingOutcome outcome(StoppedBy reason) const {
    std::uint32_t samples = done_;
    if (reason == StoppedBy::interrupt) samples = goal_.open_ended() ? std::max(done_, 1U) : most_;
    const std::uint32_t begin = goal_.samples.begin;
    return {reason, {begin, begin + samples}, allocation_.has_value()};
  }

  const SamplingGoal& goal_;
  SampleSource& source_;
  PixelList probes_;
  std::uint32_t most_;
  Pace pace_;
  std::uint32_t done_ = 0;   ///< samples of each pixel of the image
  std::uint32_t spent_ = 0;  ///< of each pixel of a pilot beside those
  double wanted_ = 0;        ///< samples that the error will be small enough with; 0: unknown

  // Of adaptive renders.
  std::optional<Allocation> allocation_;
  std::vector<std::uint32_t> counts_;  ///< samples of each pixel
  std::uint32_t least_ = 0;            ///< those that all pixels have in common at first
};

}  // namespace

SamplingOutcome render_samples(const SamplingGoal& goal, SampleSource& source) {
  return Sampling(goal, source).run();
}

Film film_of(const SamplingGoal& goal, const SampleSource& source) {
  Film film = source.sums(Sums::image);
  const bool has_begun = std::any_of(film.pixels.begin(), film.pixels.end(),
                                     [](const PixelSums& p) { return p.samples > 0; });
  if (goal.adaptive && !has_begun) return source.sums(Sums::trial);
  if (!goal.probes) return film;
  const Film trial = source.sums(Sums::trial);
  for (const std::uint32_t p : probes_of(goal)) {
    if (film.pixels[p].samples > 0 && trial.pixels[p].samples > 0)
      film.probes.push_back({p, trial.pixels[p]});
  }
  return film;
}

}  // namespace facet
