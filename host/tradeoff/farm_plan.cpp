#include "tradeoff/farm_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "image/division.h"

namespace facet::tradeoff {

namespace {

/// Of a part's time, that starting may take.
constexpr double most_starting = 0.1;

std::uint32_t samples_of(const FarmMeasurement& measured, const FarmWish& wish) {
  if (wish.samples) return *wish.samples;
  const double error = wish.error.value();
  if (!(measured.relative_upper > 0))
    throw InputError(
        "the samples that were measured tell of no error: a longer measurement, or a number of "
        "samples, is needed");
  const double ratio = measured.relative_upper / error;
  const double samples = std::max(1.0, std::ceil(measured.samples * ratio * ratio));
  if (samples > largest_sample_count)
    throw InputError(
        fmt::format("an error of {:.3g} % would take {:.3g} samples a pixel; there can be {}",
                    100 * error, samples, largest_sample_count));
  return static_cast<std::uint32_t>(samples);
}

std::uint32_t divided_up(std::uint32_t a, std::uint32_t b) { return (a + b - 1) / b; }

}  // namespace

FarmPlan plan_farm(const FarmMeasurement& measured, const FarmWish& wish) {
  FarmPlan plan;
  plan.samples = samples_of(measured, wish);
  const double seconds = plan.samples * measured.seconds_per_sample;
  const double rounds = std::max(1.0, std::ceil(seconds / wish.longest_part / wish.nodes));
  const double worth = seconds * most_starting / std::max(measured.start_seconds, 1e-6);
  const double parts =
      std::min({rounds * wish.nodes, std::floor(worth), static_cast<double>(plan.samples),
                static_cast<double>(most_shares)});
  plan.parts = static_cast<std::uint32_t>(std::max(1.0, parts));
  plan.part_samples = divided_up(plan.samples, plan.parts);
  plan.rounds = divided_up(plan.parts, wish.nodes);
  plan.part_seconds = measured.start_seconds + plan.part_samples * measured.seconds_per_sample;
  plan.merge_seconds = plan.parts * measured.merge_seconds;
  plan.seconds = plan.rounds * plan.part_seconds + plan.merge_seconds;
  const double seconds_of_nodes =
      plan.parts * measured.start_seconds + seconds + plan.merge_seconds;
  plan.node_hours = seconds_of_nodes / 3600;
  plan.bytes = plan.parts * measured.part_bytes;
  return plan;
}

}  // namespace facet::tradeoff
