#pragma once
// Which samples of each pixel a file holds.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace facet::cli {

/// Samples [begin, end).
struct SampleRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// Ranges that neither overlap nor touch nor are empty, in ascending order.
class SampleRanges {
 public:
  SampleRanges() = default;
  /// "0:8,12:16"; nothing where the text is no such list in ascending order, or has samples of 2^30 or
  /// more.
  [[nodiscard]] static std::optional<SampleRanges> parse(std::string_view text);

  void add(const SampleRange& range);
  void add(const SampleRanges& other);

  [[nodiscard]] const std::vector<SampleRange>& list() const { return list_; }
  [[nodiscard]] std::uint32_t count() const;
  /// From the first sample to the last, gaps filled.
  [[nodiscard]] SampleRange hull() const { return {list_.front().begin, list_.back().end}; }
  /// Those in both.
  [[nodiscard]] SampleRanges common(const SampleRanges& other) const;
  /// Those of the range that are not here.
  [[nodiscard]] SampleRanges missing_in(const SampleRange& range) const;
  [[nodiscard]] bool empty() const { return list_.empty(); }
  /// As parse() takes it.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<SampleRange> list_;
};

}  // namespace facet::cli
