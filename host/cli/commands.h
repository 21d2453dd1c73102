#pragma once
// The subcommands. Each adds itself to the command line, with its options and what it does.
#include <string>

#include "cli/command_line.h"

namespace facet::cli {

void add_render_command(CommandLine& line);
void add_bench_command(CommandLine& line);
void add_tradeoff_command(CommandLine& line);
void add_parity_command(CommandLine& line);
void add_merge_command(CommandLine& line);
void add_farm_plan_command(CommandLine& line);
void add_test_command(CommandLine& line);
void add_extremes_command(CommandLine& line);
void add_info_command(CommandLine& line);
void add_compare_command(CommandLine& line);
void add_devices_command(CommandLine& line);
void add_selftest_command(CommandLine& line);
void add_manual_command(CommandLine& line);

/// Seconds since the process began.
[[nodiscard]] double seconds_since_start();

}  // namespace facet::cli
