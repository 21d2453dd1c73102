#pragma once
// Pearson's chi-squared statistic of counts against expectations.
#include <cstdint>
#include <vector>

namespace facet::statistics {

/// Samples in a bin.
struct Count {
  double expected = 0;
  double observed = 0;
};

class Pearson {
 public:
  /// Bins that expect fewer than `least` are pooled, smallest first, until the pool expects as many
  /// (W. Cochran, "Some Methods for Strengthening the Common Chi-Squared Tests", 1954). What is
  /// expected nowhere else, by a bin that expects nothing, may hold `forgiven` samples; others join
  /// the pool.
  Pearson(std::vector<Count> bins, double least, double forgiven = 0);

  /// One more term, of samples in no bin, whose expectation may be off by `slack`.
  void add_rest(const Count& rest, double slack);

  [[nodiscard]] double statistic() const { return statistic_; }
  /// Of freedom, the sum of all counts being given.
  [[nodiscard]] double degrees() const { return terms_ - 1.0; }
  /// Bins of their own, without pool and rest.
  [[nodiscard]] std::uint32_t populated() const { return populated_; }
  /// Whether more samples than are forgiven fell where none is expected.
  [[nodiscard]] bool has_impossible() const { return impossible_; }
  /// 0 also where anything is not a number.
  [[nodiscard]] double p_value() const;

 private:
  void add_term(double difference, double expected);

  double least_;
  double statistic_ = 0;
  std::uint32_t terms_ = 0;
  std::uint32_t populated_ = 0;
  bool impossible_ = false;
};

}  // namespace facet::statistics
