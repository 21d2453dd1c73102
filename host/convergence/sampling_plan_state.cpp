// Where a plan stands, and plans that are taken up again.
#include <cmath>
#include <stdexcept>

#include "convergence/sampling_plan.h"

namespace facet {

namespace {

using Sums = SamplingTask::Sums;
using Stage = SamplingState::Stage;

}  // namespace

SamplingState SamplingPlan::state() const {
  SamplingState state = state_;
  if (step_is_done()) state.end_step();
  return state;
}

SampleRange SamplingPlan::whole_samples() const {
  std::uint32_t samples = allocation_ ? state_.done : state_.whole_samples();
  if (!allocation_ && state_.task == 0 && step_is_done()) samples += state_.length;
  return {goal_.samples.begin, goal_.samples.begin + samples};
}

bool SamplingPlan::is_uneven() const {
  if (goal_.adaptive) return state_.more > 0 || state_.done == 0;
  const SampleRange whole = whole_samples();
  return whole.begin == whole.end || (state_.task == 0 && state_.length > 0 && !step_is_done());
}

void SamplingPlan::restore(const SamplingState& state) {
  const auto require = [](bool holds) {
    if (!holds) throw std::invalid_argument("a state of sampling that cannot be");
  };
  const std::size_t pixels = goal_.pixels();
  const auto fits = [&](std::size_t size) { return size == 0 || size == pixels; };
  require(state.stage <= Stage::image && (goal_.adaptive || state.stage == Stage::image));
  require(state.done <= most_ && state.more <= most_ - state.done && state.pilot <= 32);
  require(fits(state.counts.size()) && fits(state.wishes.size()) && fits(state.first_half.size()));
  require(goal_.adaptive || (state.counts.empty() && state.wishes.empty()));
  require(state.stage != Stage::second_half_of_pilot || !state.first_half.empty());
  require(state.wishes.empty() == state.counts.empty() || state.done == 0);
  require(std::isfinite(state.wanted) && state.wanted >= 0);
  for (const std::uint32_t count : state.counts) require(count <= 1U << 30U);
  for (const double wish : state.wishes) require(std::abs(wish) <= 2000);
  state_ = state;
  allocation_.reset();
  if (!state.wishes.empty()) allocation_.emplace(state.wishes);
  // What is left of a long round may not fit into the time that there is now.
  const bool shorten = goal_.deadline && !allocation_ && state.stage == Stage::image &&
                       state.task == 0 && state.sample + state.length > 0;
  if (shorten) state_.more = state.sample + state.length;
  const bool begins_pilot = state.stage == Stage::first_half_of_pilot && state.pilot == 0;
  const bool is_between = state.stage == Stage::image && state_.more == 0;
  std::vector<SamplingTask> all;
  if (begins_pilot || is_between) {
    // Between rounds there is nothing to do; before a pilot there may be one sample, for its time.
    all.push_back({Sums::image, {}, {0, begins_pilot ? 1U : 0U}, 0});
  } else if (state.stage == Stage::image) {
    all = tasks_of_round(counts_of_round());
  } else {
    all.push_back(pilot_task());
  }
  require(state.task < all.size());
  const SamplingTask& task = all[state.task];
  const std::uint32_t length = task.samples.end - task.samples.begin;
  require(state.sample <= length && state.length <= length - state.sample);
  require(state.length == 0 ? state.pixel == 0
                            : state.pixel < (task.pixels.empty() ? pixels : task.pixels.size()));
}

RenderState state_of(const SamplingPlan& plan, const SamplingGoal& goal) {
  RenderState state;
  state.plan = plan.state();
  state.first = goal.samples.begin;
  state.most = goal.samples.end - goal.samples.begin;
  state.timed = goal.deadline.has_value();
  state.error = goal.error;
  state.probes = goal.probes;
  return state;
}

void add_counts(RenderStatistics& statistics, const RenderStatistics& more) {
  statistics.closest_rays += more.closest_rays;
  statistics.any_rays += more.any_rays;
  statistics.samples += more.samples;
  statistics.bad_samples += more.bad_samples;
  statistics.bound_hits += more.bound_hits;
  statistics.render_seconds += more.render_seconds;
}

}  // namespace facet
