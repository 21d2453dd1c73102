// A plan that is left and taken up again, on a source whose samples are numbers of their pixel and
// index alone: it ends with the bits of one that ran through.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "convergence/sampling_plan.h"
#include "image/film.h"

namespace facet::test {
namespace {

using namespace std::chrono_literals;
using Sums = SampleSource::Sums;

constexpr int side = 24;
constexpr auto pixels_of_film = static_cast<std::size_t>(side) * side;

using Films = std::array<Film, 2>;

/// A noisy number that pixel, sample and seed decide; every seventh pixel is ten times as noisy.
double value_of(std::uint32_t pixel, std::uint32_t sample, std::uint32_t seed) {
  std::uint32_t x = pixel * 0x9e3779b9U ^ sample * 0x85ebca6bU ^ seed;
  for (const std::uint32_t factor : {0x7feb352dU, 0x846ca68bU}) {
    x ^= x >> 16U;
    x *= factor;
  }
  return 1 + (pixel % 7 == 0 ? 10 : 1) * ((x >> 8U) * 0x1p-24 - 0.5);
}

class Source : public SampleSource {
 public:
  explicit Source(Films films) : films_(std::move(films)) {}

  std::uint32_t pixels_at_a_time = side * side;
  int calls_left = 1 << 30;           ///< of the progress, until it is interrupted
  Clock::duration per_sample = 50us;  ///< of all pixels
  [[nodiscard]] const Films& films() const { return films_; }

  bool add(const SamplingTask& task, std::uint32_t& next) override {
    const std::size_t count = task.pixels.empty() ? pixels_of_film : task.pixels.size();
    while (next < count) {
      const auto end =
          static_cast<std::uint32_t>(std::min<std::size_t>(count, next + pixels_at_a_time));
      for (; next < end; ++next) {
        const std::uint32_t p = task.pixels.empty() ? next : task.pixels[next];
        for (std::uint32_t k = task.samples.begin; k < task.samples.end; ++k) {
          const double value = value_of(p, k, task.seed);
          films_.at(static_cast<std::size_t>(task.sums)).pixels[p].add({value, value, value});
        }
      }
      now_ += per_sample * (task.samples.end - task.samples.begin);
      if (--calls_left <= 0) return false;
    }
    return true;
  }
  [[nodiscard]] Film sums(Sums of) const override {
    return films_.at(static_cast<std::size_t>(of));
  }
  void clear(Sums which) override {
    for (PixelSums& p : films_.at(static_cast<std::size_t>(which)).pixels) p = {};
  }
  void expect(double /*samples*/) override {}
  [[nodiscard]] Clock::time_point now() const override { return now_; }

 private:
  Films films_;
  Clock::time_point now_{};
};

Films blank() {
  const Film film = make_film(side, side, {0, 0, side, side}, true);
  return {film, film};
}

struct Ended {
  SamplingOutcome outcome;
  Films films;
  int legs = 0;  ///< runs that it took
};

/// Runs a plan, which is left after so many calls each time.
Ended run_in_legs(const SamplingGoal& goal, int calls, std::uint32_t pixels_at_a_time) {
  Films films = blank();
  SamplingState state = SamplingPlan(goal).state();
  for (int leg = 1;; ++leg) {
    Source source(films);
    source.calls_left = calls;
    // Whoever continues may have more paths in flight, and be slower.
    source.pixels_at_a_time = leg % 2 == 0 ? pixels_at_a_time : 3 * pixels_at_a_time;
    source.per_sample = leg % 3 == 0 ? 50us : 100ms;
    SamplingPlan plan(goal);
    plan.restore(state);
    const SamplingOutcome outcome = plan.run(source);
    films = source.films();
    state = plan.state();
    if (outcome.stopped_by != StoppedBy::interrupt) return {outcome, films, leg};
  }
}

void expect_resumed_equals_whole(const SamplingGoal& goal) {
  const Ended whole = run_in_legs(goal, 1 << 30, side * side);
  EXPECT_EQ(whole.legs, 1);
  for (const int calls : {1, 2, 3, 5, 17}) {
    const Ended resumed = run_in_legs(goal, calls, 50);
    EXPECT_GT(resumed.legs, 1);
    EXPECT_EQ(resumed.outcome.stopped_by, whole.outcome.stopped_by);
    EXPECT_EQ(resumed.outcome.samples.end, whole.outcome.samples.end);
    EXPECT_EQ(resumed.films[0].pixels, whole.films[0].pixels) << calls << " calls";
    EXPECT_EQ(resumed.films[1].pixels, whole.films[1].pixels) << calls << " calls";
  }
}

SamplingGoal goal_of(std::uint32_t samples) {
  return {side, side, {0, samples}, 7, false, false, {}, {}};
}

TEST(ResumedPlan, of_a_count_of_samples) {
  SamplingGoal goal = goal_of(0);
  goal.samples = {5, 75};
  expect_resumed_equals_whole(goal);
  goal.probes = true;
  expect_resumed_equals_whole(goal);
}

TEST(ResumedPlan, of_an_error) {
  SamplingGoal goal = goal_of(1U << 20U);
  goal.error = 0.1;
  expect_resumed_equals_whole(goal);
  goal.probes = true;
  expect_resumed_equals_whole(goal);
}

TEST(ResumedPlan, of_adaptive_sampling) {
  SamplingGoal goal = goal_of(64);
  goal.adaptive = true;
  expect_resumed_equals_whole(goal);
  goal.probes = true;
  expect_resumed_equals_whole(goal);
  goal.samples.end = 1U << 20U;
  goal.error = 0.1;
  expect_resumed_equals_whole(goal);
}

// The time of another process is another one.
TEST(ResumedPlan, of_a_time_goes_on_for_the_time_that_there_is_now) {
  for (const bool adaptive : {false, true}) {
    SamplingGoal goal = goal_of(1U << 30U);
    goal.adaptive = adaptive;
    Source first(blank());
    goal.deadline = first.now() + 10s;
    first.calls_left = 40;
    SamplingPlan begun(goal);
    EXPECT_EQ(begun.run(first).stopped_by, StoppedBy::interrupt);
    Source second(first.films());
    goal.deadline = second.now() + 100ms;
    SamplingPlan continued(goal);
    continued.restore(begun.state());
    const std::uint32_t before = begun.state().done;
    const SamplingOutcome outcome = continued.run(second);
    EXPECT_EQ(outcome.stopped_by, StoppedBy::time);
    EXPECT_GT(outcome.samples.end, before);
    if (!adaptive) {
      EXPECT_LE(second.now() - Clock::time_point(), 110ms);
    }
  }
}

// Whoever saves a render can wait for all pixels to have the same samples, and not for long.
TEST(ResumedPlan, pixels_have_the_same_samples_again_and_again) {
  Source source(blank());
  source.pixels_at_a_time = 100;
  source.per_sample = 20ms;
  SamplingPlan plan(goal_of(1000));
  int even = 0;
  for (int calls = 1; calls <= 60; ++calls) {
    source.calls_left = 1;
    (void)plan.run(source);
    if (plan.is_uneven()) continue;
    ++even;
    const SampleRange whole = plan.whole_samples();
    for (const PixelSums& p : source.films()[0].pixels) ASSERT_EQ(p.samples, whole.end);
  }
  EXPECT_GE(even, 60 / 6 - 1);
}

TEST(ResumedPlan, states_that_cannot_be_are_refused) {
  SamplingGoal goal = goal_of(100);
  const auto expect_refused = [&](const auto& change) {
    SamplingState state;
    state.done = 32;
    state.more = 32;
    state.sample = 8;
    SamplingPlan(goal).restore(state);
    change(state);
    EXPECT_THROW(SamplingPlan(goal).restore(state), std::invalid_argument);
  };
  expect_refused([](SamplingState& s) { s.done = 101; });
  expect_refused([](SamplingState& s) { s.more = 69; });
  expect_refused([](SamplingState& s) { s.task = 1; });
  expect_refused([](SamplingState& s) { s.sample = 33; });
  expect_refused([](SamplingState& s) { s.length = 25; });
  expect_refused([](SamplingState& s) { s.pixel = 1; });
  expect_refused([](SamplingState& s) { s.length = 1, s.pixel = side * side; });
  expect_refused([](SamplingState& s) { s.more = 0; });
  expect_refused([](SamplingState& s) { s.wanted = -1; });
  expect_refused([](SamplingState& s) { s.stage = SamplingState::Stage::first_half_of_pilot; });
  expect_refused([](SamplingState& s) { s.counts.resize(pixels_of_film); });
  expect_refused([](SamplingState& s) { s.wishes.resize(7); });
  goal.adaptive = true;
  expect_refused([](SamplingState& s) { s.stage = SamplingState::Stage::second_half_of_pilot; });
}

}  // namespace
}  // namespace facet::test
