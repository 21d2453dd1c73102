#pragma once
// Discrete choices among weights by 32-bit words (docs/reference/sampling.md, "Choices").
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace facet::reference {

/// What a choice leaves of the x-th of n words, a word again; `fill` stands behind x. x < n.
[[nodiscard]] inline std::uint32_t remainder_of(std::uint64_t x, std::uint64_t n,
                                                std::uint32_t fill) {
  return static_cast<std::uint32_t>(((x << 32U) + fill) / n);
}

/// A choice between two.
class TwoWayChoice {
 public:
  /// p: of the first, in [0, 1].
  explicit TwoWayChoice(double p) : words_(static_cast<std::uint64_t>(std::ldexp(p, 32))) {}

  /// Of the first, in whole words.
  [[nodiscard]] double probability() const { return std::ldexp(static_cast<double>(words_), -32); }

  [[nodiscard]] bool is_first(std::uint32_t word) const { return word < words_; }

  /// What is left of a word that has made the choice, be it that rounding had a say in it.
  [[nodiscard]] std::uint32_t remainder(bool first, std::uint32_t word, std::uint32_t fill) const {
    constexpr std::uint64_t all = 1ULL << 32U;
    if (words_ == 0 || words_ >= all) return word;
    if (first) return remainder_of(std::min<std::uint64_t>(word, words_ - 1), words_, fill);
    return remainder_of(std::max<std::uint64_t>(word, words_) - words_, all - words_, fill);
  }

 private:
  std::uint64_t words_;
};

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

  /// The entry that a word falls to, and what is left of the word.
  struct Outcome {
    std::size_t entry = 0;
    std::uint32_t remainder = 0;
  };
  [[nodiscard]] Outcome choose(std::uint32_t word, std::uint32_t fill) const {
    if (ends_.empty()) return {};
    word = std::min(word, 0xfffffffeU);
    const auto end = std::upper_bound(ends_.begin(), ends_.end() - 1, word);
    const auto entry = static_cast<std::size_t>(end - ends_.begin());
    if (width(entry) == 0) return {entry};
    if (width(entry) == words) return {entry, word};
    return {entry, remainder_of(word - begin_of(entry), ends_[entry] - begin_of(entry), fill)};
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
