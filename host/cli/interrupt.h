#pragma once
// Ctrl-C ends a render early instead of killing it; a second one kills.

namespace facet::cli {

/// From now on SIGINT, SIGTERM and SIGHUP set a flag, unless they are ignored.
void catch_interrupts();

[[nodiscard]] bool was_interrupted();

}  // namespace facet::cli
