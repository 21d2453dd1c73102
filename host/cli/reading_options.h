#pragma once
// Options about what is read of a scene.
#include "cli/command_line.h"
#include "core/diagnostics.h"

namespace facet::cli {

/// --strict and --assets-below.
void add_reading_options(Command& command, ReadingRules& rules);

}  // namespace facet::cli
