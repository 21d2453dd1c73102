#pragma once
// Ctrl-C ends a render early instead of killing it; another one, half a second later or more,
// kills.

namespace facet::cli {

/// From now on SIGINT, SIGTERM and SIGHUP set a flag, unless they are ignored. To be called when
/// there is something to save: until then, as while a scene is read, a signal ends the program at
/// once.
void catch_interrupts();

[[nodiscard]] bool was_interrupted();

/// From now on a crash, which a driver that gets no memory ends in, is told in one line and has the
/// exit code of a failed device. Not under AddressSanitizer, which has more to tell.
void tell_of_crashes();

}  // namespace facet::cli
