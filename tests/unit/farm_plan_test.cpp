// Plans of a render on many nodes, from what a short one took.
#include "tradeoff/farm_plan.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace facet::tradeoff::test {

namespace {

/// Ten samples in ten seconds, with an error of 20 %; two seconds to start.
FarmMeasurement measured() {
  FarmMeasurement m;
  m.start_seconds = 2;
  m.seconds_per_sample = 1;
  m.samples = 10;
  m.relative_upper = 0.2;
  m.part_bytes = 1e6;
  m.merge_seconds = 0.1;
  return m;
}

TEST(FarmPlan, EveryNodeHasPartsNoLongerThanAsked) {
  const FarmPlan plan = plan_farm(measured(), {.nodes = 8, .samples = 10000, .longest_part = 600});
  // 10,000 s on eight nodes: three rounds of at most 600 s.
  EXPECT_EQ(plan.parts, 24U);
  EXPECT_EQ(plan.rounds, 3U);
  EXPECT_EQ(plan.part_samples, 417U);
  EXPECT_DOUBLE_EQ(plan.part_seconds, 419);
  EXPECT_DOUBLE_EQ(plan.merge_seconds, 2.4);
  EXPECT_DOUBLE_EQ(plan.seconds, 3 * 419 + 2.4);
  EXPECT_DOUBLE_EQ(plan.node_hours, (10000 + 24 * 2 + 2.4) / 3600);
  EXPECT_DOUBLE_EQ(plan.bytes, 24e6);
}

TEST(FarmPlan, SamplesFollowFromTheErrorsSquare) {
  const FarmPlan plan = plan_farm(measured(), {.nodes = 4, .error = 0.01});
  EXPECT_EQ(plan.samples, 4000U);
  EXPECT_EQ(plan_farm(measured(), {.nodes = 4, .error = 0.2}).samples, 10U);
  EXPECT_EQ(plan_farm(measured(), {.nodes = 4, .error = 0.9}).samples, 1U);
}

TEST(FarmPlan, PartsDoNotMostlyStart) {
  // Of 100 s, parts of less than 20 s would be for starting by more than a tenth.
  const FarmPlan plan = plan_farm(measured(), {.nodes = 1000, .samples = 100});
  EXPECT_EQ(plan.parts, 5U);
  EXPECT_EQ(plan.rounds, 1U);
  EXPECT_EQ(plan_farm(measured(), {.nodes = 1000, .samples = 1}).parts, 1U);
}

TEST(FarmPlan, PartsAreNoMoreThanSamples) {
  FarmMeasurement slow = measured();
  slow.seconds_per_sample = 1000;
  const FarmPlan plan = plan_farm(slow, {.nodes = 64, .samples = 10});
  EXPECT_EQ(plan.parts, 10U);
  EXPECT_EQ(plan.part_samples, 1U);
}

TEST(FarmPlan, WhatCannotBeToldIsRefused) {
  FarmMeasurement black = measured();
  black.relative_upper = 0;
  EXPECT_THROW((void)plan_farm(black, {.nodes = 2, .error = 0.01}), InputError);
  EXPECT_THROW((void)plan_farm(measured(), {.nodes = 2, .error = 1e-7}), InputError);
}

}  // namespace

}  // namespace facet::tradeoff::test
