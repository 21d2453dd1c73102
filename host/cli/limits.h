#pragma once
// Limits of the whole program, for services that render strangers' scenes.
#include <optional>
#include <string>

#include "cli/command_line.h"

namespace facet::cli {

struct Limits {
  std::optional<std::string> memory;  ///< bytes, as "2G"
  std::optional<double> time;         ///< seconds since the process began
};

/// --limit-memory and --limit-time.
void add_limit_options(Command& command, Limits& limits);

/// From now on, allocations beyond the memory are refused, and a process that still runs when its
/// time is over says so and ends. Throws InputError for what is no size.
void set_limits(const Limits& limits);

}  // namespace facet::cli
