#pragma once
// What `facet bench` measured: lines for people, and JSON.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/growth.h"
#include "bench/traversal.h"
#include "bench/whole_render.h"

namespace facet::report {

struct BenchReport {
  std::string device;
  std::string driver;
  std::vector<bench::TraversalResult> traversal;
  std::vector<bench::RenderRow> renders;
  std::vector<bench::GrowthSeries> growth;
};

/// Median with the least and the greatest in parentheses, the median at least so many characters
/// wide.
[[nodiscard]] std::string figure_text(const Figure& figure, double scale = 1, int width = 0);
[[nodiscard]] std::string seconds_text(const Figure& figure);
[[nodiscard]] double bytes_a_triangle(std::uint64_t bytes, const bench::TraversalResult& result);

/// Several lines each, the last one ended.
[[nodiscard]] std::string text_of(const bench::TraversalResult& result);
[[nodiscard]] std::string text_of(const bench::RenderRow& row);
[[nodiscard]] std::string text_of(const bench::GrowthSeries& series);

/// {"device", "driver", "threads", "yardstick", "traversal", "build", "render", "growth"}: rays in
/// millions a second.
[[nodiscard]] nlohmann::ordered_json bench_json(const BenchReport& report);

}  // namespace facet::report
