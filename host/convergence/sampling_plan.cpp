#include "convergence/sampling_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "convergence/probes.h"

namespace facet {

namespace {

using Sums = SamplingTask::Sums;
using Stage = SamplingState::Stage;

// Numbers of other samples than the image's.
constexpr std::uint32_t pilot_seed = 0x9e3779b9U;
constexpr std::uint32_t probe_seed = 0x85ebca6bU;

/// Fewest samples a pixel whose error is estimated.
constexpr std::uint32_t least_estimated = 16;

/// Of one look at the error: whoever looks several times, as at a goal of 95 %, errs more often.
constexpr double confidence = 0.99;

/// Samples of a pilot where nobody knows how many will follow.
constexpr std::uint32_t open_ended_pilot = 16;

/// Fewest samples of a pilot that says anything.
constexpr std::uint32_t least_pilot = 4;

/// Seconds between points where every pixel has the same samples, where a sample is faster.
constexpr double seconds_of_step = 0.25;

std::uint32_t seed_of_probes(const SamplingGoal& goal) { return goal.seed ^ probe_seed; }

PixelList probes_of(const SamplingGoal& goal) {
  if (!goal.probes) return {};
  return choose_probes(goal.width, goal.height, seed_of_probes(goal));
}

Film bare_film(const SamplingGoal& goal, const std::vector<PixelSums>& pixels) {
  return {goal.width, goal.height, {0, 0, goal.width, goal.height}, true, pixels, {}, {}};
}

}  // namespace

SamplingPlan::SamplingPlan(const SamplingGoal& goal)
    : goal_(goal), probes_(probes_of(goal)), most_(goal.samples.end - goal.samples.begin) {
  if (goal.adaptive) state_.stage = Stage::first_half_of_pilot;
}

SamplingOutcome SamplingPlan::run(SampleSource& source) {
  pace_.emplace(goal_.deadline, source.now());
  expect(source, most_);
  if (!run_pilot(source)) return outcome(StoppedBy::interrupt);
  for (;;) {
    // Of a round that another run has begun, the time is not known.
    const bool begun_here = state_.more == 0;
    if (begun_here) state_.more = next_round(source);
    if (state_.more == 0)
      return outcome(state_.done == most_ ? StoppedBy::samples : StoppedBy::time);
    std::vector<std::uint32_t> counts = counts_of_round();
    if (!run_tasks(source, tasks_of_round(counts))) return outcome(StoppedBy::interrupt);
    if (begun_here) pace_->note(state_.more, source.now());
    end_round(std::move(counts));
    if (is_good_enough(source)) return outcome(StoppedBy::error);
  }
}

/// Samples a pixel of the next round: 1, 1, 2, 4, ..., which give an early picture of the whole;
/// fewer where a goal is near.
std::uint32_t SamplingPlan::next_round(SampleSource& source) {
  const std::uint32_t done = state_.done;
  std::uint32_t more = std::max(done, 1U);
  if (allocation_ && done == 0) more = goal_.open_ended() ? open_ended_pilot : most_;
  more = std::min(more, most_ - done);
  if (state_.wanted > 0) {
    const double wanted = std::ceil(state_.wanted) - done;
    more = std::min(more, static_cast<std::uint32_t>(std::clamp(wanted, 1.0, 0x1p30)));
  }
  if (pace_->is_limited()) {
    const std::uint32_t fitting = pace_->fitting(source.now());
    const bool must = done == 0 || (!pace_->is_known() && pace_->seconds_left(source.now()) > 0);
    more = std::min(more, must ? std::max(fitting, allocation_ ? 2U : 1U) : fitting);
  }
  tell_expectations(source);
  return more;
}

SamplingTask SamplingPlan::pilot_task() const {
  const std::uint32_t half = state_.pilot / 2;
  const SampleRange samples = state_.stage == Stage::first_half_of_pilot
                                  ? SampleRange{goal_.deadline ? 1U : 0U, half}
                                  : SampleRange{half, state_.pilot};
  return {Sums::trial, {}, samples, goal_.seed ^ pilot_seed};
}

std::vector<SamplingTask> SamplingPlan::tasks_of_round(
    const std::vector<std::uint32_t>& counts) const {
  std::vector<SamplingTask> tasks;
  if (allocation_) {
    PixelList all(counts.size());
    std::iota(all.begin(), all.end(), 0U);
    add_steps(tasks, Sums::image, std::move(all), counts, goal_.seed);
    if (!probes_.empty()) add_steps(tasks, Sums::trial, probes_, counts, seed_of_probes(goal_));
    return tasks;
  }
  const std::uint32_t begin = goal_.samples.begin + state_.done;
  const SampleRange samples{begin, begin + state_.more};
  tasks.push_back({Sums::image, {}, samples, goal_.seed});
  if (!probes_.empty()) tasks.push_back({Sums::trial, probes_, samples, seed_of_probes(goal_)});
  return tasks;
}

std::vector<std::uint32_t> SamplingPlan::counts_of_round() const {
  if (!allocation_) return {};
  const std::uint32_t mean = state_.done + state_.more;
  const std::uint32_t budget = goal_.open_ended() ? mean : mean - pilot_samples(mean);
  std::vector<std::uint32_t> counts = allocation_->counts(mean, budget);
  // A larger budget may have other bounds; what a pixel has, it keeps.
  for (std::size_t i = 0; i < state_.counts.size(); ++i)
    counts[i] = std::max(counts[i], state_.counts[i]);
  return counts;
}

/// Samples of these pixels, from the numbers that they have to others: twice as many from step to
/// step, of ever fewer.
void SamplingPlan::add_steps(std::vector<SamplingTask>& tasks, Sums sums, PixelList pixels,
                             const std::vector<std::uint32_t>& counts, std::uint32_t seed) const {
  std::uint32_t begin = 0;
  const std::uint32_t least =
      state_.least > 0 ? state_.least : smallest_allocation(state_.done + state_.more);
  for (std::uint32_t end = least;; begin = end, end *= 2) {
    std::erase_if(pixels, [&](std::uint32_t p) { return counts[p] < end; });
    if (pixels.empty()) return;
    PixelList lacking;
    std::copy_if(pixels.begin(), pixels.end(), std::back_inserter(lacking),
                 [&](std::uint32_t p) { return state_.counts.empty() || state_.counts[p] < end; });
    if (!lacking.empty()) tasks.push_back({sums, std::move(lacking), {begin, end}, seed});
  }
}

/// As far as they are not done.
bool SamplingPlan::run_tasks(SampleSource& source, const std::vector<SamplingTask>& tasks) {
  for (; state_.task < tasks.size(); ++state_.task) {
    if (!run_task(source, tasks[state_.task])) return false;
    state_.sample = 0;
  }
  state_.task = 0;
  return true;
}

bool SamplingPlan::run_task(SampleSource& source, const SamplingTask& task) {
  pixels_of_task_ = task.pixels.empty() ? goal_.pixels() : task.pixels.size();
  SamplingTask step = task;
  while (state_.length > 0 || state_.sample < task.samples.end - task.samples.begin) {
    step.samples.begin = task.samples.begin + state_.sample;
    if (state_.length == 0) {
      state_.length = std::min(pace_->step(static_cast<double>(pixels_of_task_), seconds_of_step),
                               task.samples.end - step.samples.begin);
    }
    step.samples.end = step.samples.begin + state_.length;
    const Clock::time_point start = source.now();
    const std::uint32_t first = state_.pixel;
    const bool goes_on = source.add(step, state_.pixel);
    pace_->note_pixels(static_cast<double>(state_.pixel - first) * state_.length,
                       source.now() - start);
    if (step_is_done()) state_.end_step();
    if (!goes_on) return false;
  }
  return true;
}

void SamplingPlan::end_round(std::vector<std::uint32_t> counts) {
  if (allocation_ && state_.least == 0)
    state_.least = smallest_allocation(state_.done + state_.more);
  state_.counts = std::move(counts);
  state_.done += state_.more;
  state_.more = 0;
}

/// Decides how long the pilot is; returns whether to go on.
bool SamplingPlan::begin_pilot(SampleSource& source) {
  std::uint32_t samples = goal_.open_ended() ? open_ended_pilot : pilot_samples(most_);
  if (pace_->is_limited()) {
    // One sample tells how long others take.
    if (!run_task(source, {Sums::trial, {}, {0, 1}, goal_.seed ^ pilot_seed})) return false;
    state_.sample = 0;
    pace_->note(1, source.now());
    samples = std::min(samples, std::bit_floor(pace_->fitting(source.now(), 0.125) + 1));
  }
  state_.pilot = samples;
  return true;
}

/// Renders the pilot, if there is to be one, and throws it away; returns whether to go on.
bool SamplingPlan::run_pilot(SampleSource& source) {
  if (state_.stage == Stage::image) return true;
  const std::uint32_t timing = pace_->is_limited() ? 1 : 0;
  if (state_.pilot == 0) {
    if (pace_->is_limited() && !(pace_->seconds_left(source.now()) > 0)) {
      state_.stage = Stage::image;
      return true;
    }
    if (!begin_pilot(source)) return false;
  }
  // In the shortest of times a pilot would take what the image needs.
  if (state_.pilot < least_pilot) {
    if (goal_.open_ended()) state_.spent = timing;
  } else {
    if (state_.stage == Stage::first_half_of_pilot) {
      if (!run_tasks(source, {pilot_task()})) return false;
      state_.first_half = source.sums(Sums::trial).pixels;
      state_.stage = Stage::second_half_of_pilot;
    }
    if (!run_tasks(source, {pilot_task()})) return false;
    pace_->note(state_.pilot - timing, source.now());
    allocation_.emplace(bare_film(goal_, state_.first_half), source.sums(Sums::trial));
    if (goal_.open_ended()) state_.spent = state_.pilot;
    state_.wishes = allocation_->wishes();
  }
  state_.first_half.clear();
  state_.pilot = 0;
  state_.stage = Stage::image;
  source.clear(Sums::trial);
  return true;
}

/// Looks at the error, where it matters, and at how many samples it would take.
bool SamplingPlan::is_good_enough(const SampleSource& source) {
  const std::uint32_t done = state_.done;
  if (!goal_.error || (done < least_estimated && done < most_)) return false;
  const ErrorEstimate estimate = estimate_error(film_of(goal_, source));
  const double excess = estimate.relative_upper(confidence) / *goal_.error;
  // An image without light or noise has an error of 0.
  if (excess <= 1) return true;
  // The error of samples in an order falls faster than that of independent ones. Better look
  // again than render too much, but not for the sake of a few.
  const double power = probes_.empty() ? 2.0 : 4.0 / 3.0;
  state_.wanted = done * std::max(std::pow(excess, power), 1.05);
  return false;
}

void SamplingPlan::tell_expectations(SampleSource& source) const {
  double samples = most_;
  if (state_.wanted > 0) samples = std::min(samples, state_.wanted);
  if (pace_->is_limited())
    samples = std::min(samples, static_cast<double>(state_.done) + pace_->fitting(source.now()));
  expect(source, samples);
}

/// samples: of the image, a pixel.
void SamplingPlan::expect(SampleSource& source, double samples) const {
  source.expect((samples + state_.spent) * static_cast<double>(goal_.pixels()) +
                samples * static_cast<double>(probes_.size()));
}

SamplingOutcome SamplingPlan::outcome(StoppedBy reason) const {
  std::uint32_t samples = state_.done;
  if (reason == StoppedBy::interrupt)
    samples = goal_.open_ended() ? std::max(state_.done, 1U) : most_;
  const std::uint32_t begin = goal_.samples.begin;
  return {reason, {begin, begin + samples}, allocation_.has_value()};
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
