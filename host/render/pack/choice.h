#pragma once
// Discrete choices by 32-bit words (docs/reference/sampling.md, "Choices").
#include <cstdint>
#include <span>
#include <vector>

namespace facet {

/// Cumulative counts of words: entry i is chosen by the words in [c[i-1], c[i]). Counts are
/// proportional to the weights; a positive weight has at least one word, a zero weight none; from
/// the last positive weight on, c is 2^32 - 1. All zero if no weight is positive. Weights are
/// finite and not negative.
[[nodiscard]] std::vector<std::uint32_t> cumulative_counts(std::span<const double> weights);

/// Probability of entry i under cumulative counts.
[[nodiscard]] double choice_probability(std::span<const std::uint32_t> cumulative, std::size_t i);

}  // namespace facet
