// How many samples a render takes: by count, by error and by time, on a source of samples whose
// truth and whose clock are known.
#include "convergence/sampling_plan.h"

#include <gtest/gtest.h>

#include <bit>

#include "support/fake_samples.h"

namespace facet::test {
namespace {

using namespace std::chrono_literals;

constexpr int side = FakeSamples::side;

SamplingOutcome render_samples(const SamplingGoal& goal, SampleSource& source) {
  return SamplingPlan(goal).run(source);
}

SamplingGoal goal_of(std::uint32_t samples) {
  return {side, side, {0, samples}, 7, false, false, {}, {}};
}

/// Expects that a pixel was given these samples, each once and in order.
void expect_samples(const std::vector<SampleRange>& given, std::uint32_t begin, std::uint32_t end) {
  ASSERT_FALSE(given.empty());
  EXPECT_EQ(given.front().begin, begin);
  for (std::size_t k = 1; k < given.size(); ++k) EXPECT_EQ(given[k].begin, given[k - 1].end);
  EXPECT_EQ(given.back().end, end);
}

TEST(SamplingPlan, renders_every_sample_once_in_rounds_that_double) {
  FakeSamples source;
  SamplingGoal goal = goal_of(0);
  goal.samples = {5, 105};
  const SamplingOutcome outcome = render_samples(goal, source);
  EXPECT_EQ(outcome.stopped_by, StoppedBy::samples);
  EXPECT_EQ(outcome.samples.begin, 5U);
  EXPECT_EQ(outcome.samples.end, 105U);
  expect_samples(source.given[{SampleSource::Sums::image, 3}], 5, 105);
  const std::vector<SampleRange>& rounds = source.given[{SampleSource::Sums::image, 0}];
  ASSERT_EQ(rounds.size(), 8U);
  EXPECT_EQ(rounds[4].end - rounds[4].begin, 8U);
  EXPECT_EQ(source.expected, 100.0 * side * side);
  EXPECT_EQ(source.seeds, std::vector<std::uint32_t>(8, 7U));
}

TEST(SamplingPlan, an_interrupt_ends_it) {
  FakeSamples source;
  source.calls_left = 3;
  const SamplingOutcome outcome = render_samples(goal_of(100), source);
  EXPECT_EQ(outcome.stopped_by, StoppedBy::interrupt);
  EXPECT_EQ(outcome.samples.end, 100U);
  expect_samples(source.given[{SampleSource::Sums::image, 0}], 0, 4);
  FakeSamples open;
  open.calls_left = 3;
  SamplingGoal goal = goal_of(1U << 30U);
  goal.error = 1e-9;
  EXPECT_EQ(render_samples(goal, open).samples.end, 2U) << "what every pixel has for sure";
}

/// The samples of uniform noise of that width that give a relative error.
double samples_for(double width, double error) { return width * width / 3 / (error * error); }

/// The error is kept in as many renders as is promised, and the samples are not many more than the
/// fewest. Fewer than 88 of 100 that keep it would come of a promise of 95 % with a probability of
/// 0.2 %.
void expect_promise(double error, std::uint32_t order, bool probes) {
  int kept = 0;
  std::vector<std::uint32_t> counts;
  constexpr double width = 2;
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    FakeSamples source(seed, width);
    source.order = order;
    SamplingGoal goal = goal_of(1U << 20U);
    goal.seed = seed;
    goal.error = error;
    goal.probes = probes;
    const SamplingOutcome outcome = render_samples(goal, source);
    EXPECT_EQ(outcome.stopped_by, StoppedBy::error);
    counts.push_back(outcome.samples.end);
    kept += std::sqrt(source.true_relmse()) <= error ? 1 : 0;
  }
  std::sort(counts.begin(), counts.end());
  const double fewest = samples_for(width, error) / order;
  std::printf("error %g: kept in %d of 100 renders, %g times the fewest samples\n", error, kept,
              counts[50] / fewest);
  EXPECT_GE(kept, 88);
  EXPECT_LE(counts[50], 1.3 * fewest);
}

TEST(SamplingPlan, keeps_an_error_of_independent_samples) { expect_promise(0.1, 1, false); }

// Variances of samples alone would ask for eight times as many.
TEST(SamplingPlan, keeps_an_error_of_samples_in_an_order) { expect_promise(0.04, 8, true); }

TEST(SamplingPlan, an_error_stops_at_the_samples_that_there_may_be) {
  FakeSamples source;
  SamplingGoal goal = goal_of(50);
  goal.error = 1e-4;
  const SamplingOutcome outcome = render_samples(goal, source);
  EXPECT_EQ(outcome.stopped_by, StoppedBy::samples);
  EXPECT_EQ(outcome.samples.end, 50U);
}

TEST(SamplingPlan, an_image_without_noise_is_soon_good_enough) {
  FakeSamples source(1, 0);
  SamplingGoal goal = goal_of(1U << 30U);
  goal.error = 1e-6;
  const SamplingOutcome outcome = render_samples(goal, source);
  EXPECT_EQ(outcome.stopped_by, StoppedBy::error);
  EXPECT_EQ(outcome.samples.end, 16U);
}

TEST(SamplingPlan, ends_before_its_time_and_makes_use_of_it) {
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    FakeSamples source(seed);
    source.per_sample = std::chrono::nanoseconds(200 + 700 * (seed % 7));
    source.jitter = 0.1;
    SamplingGoal goal = goal_of(1U << 30U);
    goal.deadline = source.now() + 100ms;
    goal.adaptive = seed % 2 == 0;
    const SamplingOutcome outcome = render_samples(goal, source);
    EXPECT_EQ(outcome.stopped_by, StoppedBy::time);
    const double used = std::chrono::duration<double>(source.now() - Clock::time_point()) / 100ms;
    EXPECT_LE(used, 1.01) << seed;
    EXPECT_GE(used, 0.8) << seed;
  }
}

TEST(SamplingPlan, renders_one_sample_though_there_is_no_time) {
  for (const bool adaptive : {false, true}) {
    FakeSamples source;
    source.per_sample = 1us;
    SamplingGoal goal = goal_of(1U << 30U);
    goal.deadline = source.now() - 1s;
    goal.adaptive = adaptive;
    const SamplingOutcome outcome = render_samples(goal, source);
    EXPECT_EQ(outcome.stopped_by, StoppedBy::time);
    EXPECT_EQ(outcome.samples.end, 1U);
    EXPECT_FALSE(outcome.adaptive) << "there was no time for a pilot";
    EXPECT_EQ(source.seeds.size(), 1U) << "nor for a look at how long one would take";
    expect_samples(source.given[{SampleSource::Sums::image, side * side - 1}], 0, 1);
  }
}

TEST(SamplingPlan, whichever_goal_is_met_first_ends_it) {
  SamplingGoal goal = goal_of(64);
  goal.error = 0.001;
  FakeSamples slow;
  slow.per_sample = 1us;
  goal.deadline = slow.now() + 50ms;
  EXPECT_EQ(render_samples(goal, slow).stopped_by, StoppedBy::time);
  FakeSamples fast;
  goal.deadline = fast.now() + 50ms;
  EXPECT_EQ(render_samples(goal, fast).stopped_by, StoppedBy::samples);
  goal.error = 0.5;
  FakeSamples good;
  goal.deadline = good.now() + 50ms;
  EXPECT_EQ(render_samples(goal, good).stopped_by, StoppedBy::error);
}

TEST(SamplingPlan, an_adaptive_render_grows_pixel_by_pixel) {
  FakeSamples source(1, 2);
  source.spread = 20;
  SamplingGoal goal = goal_of(1U << 20U);
  goal.adaptive = true;
  goal.error = 0.2;
  const SamplingOutcome outcome = render_samples(goal, source);
  EXPECT_EQ(outcome.stopped_by, StoppedBy::error);
  EXPECT_TRUE(outcome.adaptive);
  double sum = 0;
  double noisy = 0;
  for (std::uint32_t p = 0; p < side * side; ++p) {
    const std::vector<SampleRange>& given = source.given[{SampleSource::Sums::image, p}];
    ASSERT_FALSE(given.empty());
    const std::uint32_t count = given.back().end;
    expect_samples(given, 0, count);
    EXPECT_TRUE(std::has_single_bit(count));
    sum += count;
    noisy += p % 16 == 0 ? count : 0;
  }
  EXPECT_NEAR(sum / (side * side) / outcome.samples.end, 1, 0.3);
  EXPECT_GT(noisy, sum / 4) << "a sixteenth of the pixels";
  // The pilot's numbers are others than the image's.
  EXPECT_NE(source.seeds.front(), source.seeds.back());
}

TEST(SamplingPlan, probes_get_the_samples_of_their_pixels_with_other_numbers) {
  for (const bool adaptive : {false, true}) {
    FakeSamples source(1, 2);
    SamplingGoal goal = goal_of(100);
    goal.probes = true;
    goal.adaptive = adaptive;
    EXPECT_EQ(render_samples(goal, source).stopped_by, StoppedBy::samples);
    const Film film = film_of(goal, source);
    EXPECT_EQ(film.probes.size(), 576U);
    for (const Probe& probe : film.probes)
      EXPECT_EQ(probe.sums.samples, film.pixels[probe.pixel].samples);
    const auto of_image = std::count(source.seeds.begin(), source.seeds.end(), goal.seed);
    EXPECT_GT(of_image, 0);
    EXPECT_LT(of_image, static_cast<std::ptrdiff_t>(source.seeds.size()));
  }
}

TEST(SamplingPlan, an_interrupt_during_the_pilot_leaves_its_film) {
  FakeSamples source;
  source.calls_left = 1;
  SamplingGoal goal = goal_of(64);
  goal.adaptive = true;
  EXPECT_EQ(render_samples(goal, source).stopped_by, StoppedBy::interrupt);
  EXPECT_EQ(film_of(goal, source).pixels[9].samples, 1U);
}

}  // namespace
}  // namespace facet::test
