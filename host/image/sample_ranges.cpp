#include <facet/film.h>
#include <fmt/format.h>

#include <algorithm>

#include "core/text.h"
#include "image/division.h"

namespace facet {

std::optional<SampleRanges> SampleRanges::parse(std::string_view text) {
  SampleRanges ranges;
  long long least = 0;
  for (const std::string_view item : split_list(text)) {
    const std::size_t colon = item.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const auto begin = parse_integer(item.substr(0, colon));
    const auto end = parse_integer(item.substr(colon + 1));
    if (!begin || !end || *begin < least || *begin >= *end || *end > largest_sample_count)
      return std::nullopt;
    least = *end;
    ranges.add(SampleRange{static_cast<std::uint32_t>(*begin), static_cast<std::uint32_t>(*end)});
  }
  if (ranges.empty()) return std::nullopt;
  return ranges;
}

void SampleRanges::add(const SampleRange& range) {
  SampleRange whole = range;
  std::erase_if(list_, [&](const SampleRange& r) {
    if (r.end < whole.begin || r.begin > whole.end) return false;
    whole = {std::min(r.begin, whole.begin), std::max(r.end, whole.end)};
    return true;
  });
  const auto place = std::find_if(list_.begin(), list_.end(),
                                  [&](const SampleRange& r) { return r.begin > whole.begin; });
  list_.insert(place, whole);
}

void SampleRanges::add(const SampleRanges& other) {
  for (const SampleRange& range : other.list_) add(range);
}

std::uint32_t SampleRanges::count() const {
  std::uint32_t sum = 0;
  for (const SampleRange& r : list_) sum += r.end - r.begin;
  return sum;
}

SampleRanges SampleRanges::common(const SampleRanges& other) const {
  SampleRanges result;
  for (const SampleRange& a : list_) {
    for (const SampleRange& b : other.list_) {
      const SampleRange both{std::max(a.begin, b.begin), std::min(a.end, b.end)};
      if (both.begin < both.end) result.add(both);
    }
  }
  return result;
}

SampleRanges SampleRanges::missing_in(const SampleRange& range) const {
  SampleRanges result;
  std::uint32_t reached = range.begin;
  for (const SampleRange& r : list_) {
    if (r.begin >= range.end) break;
    if (r.begin > reached) result.add(SampleRange{reached, r.begin});
    reached = std::max(reached, r.end);
  }
  if (reached < range.end) result.add(SampleRange{reached, range.end});
  return result;
}

std::string SampleRanges::text() const {
  std::vector<std::string> items;
  for (const SampleRange& r : list_) items.push_back(fmt::format("{}:{}", r.begin, r.end));
  return fmt::format("{}", fmt::join(items, ","));
}

}  // namespace facet
