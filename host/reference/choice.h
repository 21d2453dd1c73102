#pragma once
// Discrete choices among weights by 32-bit words (docs/sampling.md, "Choices").
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace facet::reference {

class Choice {
 public:
  Choice() = default;
  /// Weights are finite and not negative.
  explicit Choice(std::span<const double> weights) {
    double total = 0;
    double positive = 0;
    for (const double w : weights) {
      total += w;
      if (w > 0) ++positive;
    }
    double below = 0;
    double entries = 0;
    for (const double w : weights) {
      below += w;
      if (w > 0) ++entries;
      const double share = total > 0 ? std::min(below / total, 1.0) : 0;
      ends_.push_back(
          total > 0 ? static_cast<std::uint32_t>(std::floor((words - positive) * share) + entries)
                    : 0U);
    }
  }

  /// The entry that a word falls to, and how far into it, in [0, 1).
  struct Outcome {
    std::size_t entry = 0;
    double fraction = 0;
  };
  [[nodiscard]] Outcome choose(std::uint32_t word) const {
    if (ends_.empty()) return {};
    word = std::min(word, 0xfffffffeU);
    const auto end = std::upper_bound(ends_.begin(), ends_.end() - 1, word);
    const auto entry = static_cast<std::size_t>(end - ends_.begin());
    return {entry, static_cast<double>(word - begin_of(entry)) / std::max(1.0, width(entry))};
  }

  [[nodiscard]] double probability(std::size_t entry) const { return width(entry) / words; }

 private:
  static constexpr double words = 4294967295.0;

  [[nodiscard]] std::uint32_t begin_of(std::size_t entry) const {
    return entry > 0 ? ends_[entry - 1] : 0;
  }
  [[nodiscard]] double width(std::size_t entry) const {
    return static_cast<double>(ends_[entry] - begin_of(entry));
  }

  std::vector<std::uint32_t> ends_;
};

}  // namespace facet::reference
