#include "cli/interrupt.h"

#include <csignal>

#include "image/atomic_file.h"

namespace facet::cli {

namespace {

volatile std::sig_atomic_t interrupted = 0;

/// The first signal asks for an end, the second is one.
void on_signal(int number) {
  if (interrupted == 0) {
    interrupted = 1;
    return;
  }
  AtomicFile::remove_unfinished();
  (void)std::signal(number, SIG_DFL);
  (void)std::raise(number);
}

void catch_signal(int number) {
  // What a caller has set to be ignored, as nohup does, stays so.
  if (std::signal(number, on_signal) == SIG_IGN) (void)std::signal(number, SIG_IGN);
}

}  // namespace

void catch_interrupts() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) catch_signal(number);
}

bool was_interrupted() { return interrupted != 0; }

}  // namespace facet::cli
