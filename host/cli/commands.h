#pragma once
// The subcommands. Each adds itself to the parser, with its options and what it does.
#include <CLI/CLI.hpp>
#include <functional>

#include "cli/exit_code.h"

namespace facet::cli {

/// What the chosen subcommand does; set while the command line is parsed.
using Action = std::function<ExitCode()>;

void add_render_command(CLI::App& app, Action& action);
void add_bench_command(CLI::App& app, Action& action);
void add_parity_command(CLI::App& app, Action& action);
void add_merge_command(CLI::App& app, Action& action);
void add_test_command(CLI::App& app, Action& action);
void add_info_command(CLI::App& app, Action& action);
void add_compare_command(CLI::App& app, Action& action);
void add_devices_command(CLI::App& app, Action& action);

/// "facet 0.1.0 (...), needs Vulkan 1.1"
[[nodiscard]] std::string version_text();

/// Seconds since the process began.
[[nodiscard]] double seconds_since_start();

}  // namespace facet::cli
