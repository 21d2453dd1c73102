#include "render/pack/choice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace facet {

std::vector<std::uint32_t> cumulative_counts(std::span<const double> weights) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const auto positive = static_cast<double>(
      std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0; }));
  std::vector<std::uint32_t> cumulative(weights.size(), 0);
  if (!(total > 0)) return cumulative;
  const double shared = 4294967295.0 - positive;
  double prefix = 0;
  double passed = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    prefix += weights[i];
    passed += weights[i] > 0 ? 1 : 0;
    cumulative[i] =
        static_cast<std::uint32_t>(std::floor(shared * std::min(prefix / total, 1.0)) + passed);
  }
  return cumulative;
}

double choice_probability(std::span<const std::uint32_t> cumulative, std::size_t i) {
  const std::uint32_t before = i > 0 ? cumulative[i - 1] : 0;
  return static_cast<double>(cumulative[i] - before) / 4294967295.0;
}

}  // namespace facet
