#include "report/histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace facet::report {

Decades decades_of(std::span<const double> values) {
  constexpr int most_decades = 6;
  double smallest = INFINITY;
  double largest = 0;
  for (const double v : values) {
    if (!(v > 0) || std::isinf(v)) continue;
    smallest = std::min(smallest, v);
    largest = std::max(largest, v);
  }
  if (largest == 0) return {};
  const int end = static_cast<int>(std::floor(std::log10(largest))) + 1;
  const int first = static_cast<int>(std::floor(std::log10(smallest)));
  return {std::max(first, end - most_decades), end};
}

nlohmann::ordered_json histogram_json(const Histogram& h, std::span<const double> values) {
  constexpr std::size_t bins = 60;
  const Decades decades = h.logarithmic ? decades_of(values) : Decades{};
  const auto position = [&](double v) {
    return ((h.logarithmic ? std::log10(v) : v) - decades.first) / (decades.end - decades.first);
  };
  std::vector<std::size_t> counts(bins);
  std::size_t zero = 0;
  std::size_t below = 0;
  std::size_t infinite = 0;
  std::size_t nan = 0;
  for (const double v : values) {
    if (!std::isfinite(v)) {
      ++(std::isnan(v) ? nan : infinite);
    } else if (h.logarithmic && v <= 0) {
      ++zero;
    } else if (position(v) < 0) {
      ++below;
    } else {
      ++counts[std::min(static_cast<std::size_t>(position(v) * bins), bins - 1)];
    }
  }
  std::vector<std::string> beside;
  const auto say = [&](std::size_t count, const char* what) {
    if (count > 0) beside.push_back(fmt::format("{} of {} pixels {}.", count, values.size(), what));
  };
  say(zero, "have none");
  say(below, "lie below the axis");
  say(infinite, "have an infinite one");
  say(nan, "are not finite");
  const double mark = h.mark > 0 && std::isfinite(h.mark) ? position(h.mark) : -1;
  return {{"title", h.title},
          {"axis", h.axis},
          {"logarithmic", h.logarithmic},
          {"low", decades.first},
          {"high", decades.end},
          {"counts", counts},
          {"mark", {{"name", h.mark_name}, {"value", h.mark}, {"position", mark}}},
          {"beside", beside}};
}

}  // namespace facet::report
