#pragma once
// What `facet compare` found: rows for people, and JSON.
#include <nlohmann/json_fwd.hpp>

#include "compare/comparison.h"

namespace facet::report {

/// A metric as people read it: {"RMSE", "0.0123", "sqrt of ..."}.
struct MetricRow {
  std::string name;
  std::string value;
  std::string note;
};
[[nodiscard]] std::vector<MetricRow> metric_rows(const CompareOptions& options,
                                                 const Comparison& comparison);

/// The report of --json. What is infinite or undefined is null.
[[nodiscard]] nlohmann::ordered_json comparison_json(const CompareOptions& options,
                                                     const Comparison& comparison);

}  // namespace facet::report
