#include "cli/interrupt.h"

#include <csignal>

namespace facet::cli {

namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_signal(int number) {
  interrupted = 1;
  (void)std::signal(number, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  (void)std::signal(SIGINT, on_signal);
  (void)std::signal(SIGTERM, on_signal);
}

bool was_interrupted() { return interrupted != 0; }

}  // namespace facet::cli
