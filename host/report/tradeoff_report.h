#pragma once
// What `facet tradeoff` measured: a table for people, and JSON.
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tradeoff/advice.h"

namespace facet::report {

/// What was measured, and what is asked of it.
struct TradeoffReport {
  const tradeoff::Tradeoff& tradeoff;
  std::optional<double> wanted_error;  ///< relative: which setting gets there soonest
};

/// Settings by efficiency at their most samples, the best first; those that cannot have it last.
[[nodiscard]] std::vector<std::size_t> by_efficiency(const tradeoff::Tradeoff& tradeoff);

/// Several lines, the last one ended.
[[nodiscard]] std::string text_of(const TradeoffReport& report);

/// The command that reaches the wanted error soonest; empty where none is wanted, or nothing known.
[[nodiscard]] std::string advised_command(const TradeoffReport& report);

/// {"scene", "device", "driver", "width", "height", "seeds", "startup_seconds", "reference",
/// "points", "best", "recommendation"}.
[[nodiscard]] nlohmann::ordered_json tradeoff_json(const TradeoffReport& report);

}  // namespace facet::report
