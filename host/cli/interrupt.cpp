#include "cli/interrupt.h"

#include <unistd.h>

#include <array>
#include <csignal>
#include <ctime>
#include <exception>
#include <string_view>

#include "cli/exit_code.h"
#include "core/atomic_file.h"
#include "core/sanitized.h"

namespace facet::cli {

namespace {

volatile std::sig_atomic_t interrupted = 0;
timespec first_time{};  ///< of the first signal

/// Async-signal-safe.
timespec monotonic_time() {
  timespec time{};
  (void)::clock_gettime(CLOCK_MONOTONIC, &time);
  return time;
}

/// The first signal asks for an end, a later one is one. What timeout(1) and batch systems send
/// comes twice within moments, to the process and to its group, and means one.
void on_signal(int number) {
  constexpr long moments = 500'000'000;  // ns
  const timespec now = monotonic_time();
  if (interrupted == 0) {
    first_time = now;
    interrupted = 1;
    return;
  }
  const auto seconds = now.tv_sec - first_time.tv_sec;
  if (seconds < 2 && seconds * 1'000'000'000 + now.tv_nsec - first_time.tv_nsec < moments) return;
  AtomicFile::remove_unfinished();
  (void)std::signal(number, SIG_DFL);
  (void)std::raise(number);
}

/// Nothing here may allocate or lock: what crashed may have been an allocation.
[[noreturn]] void give_up(std::string_view message) {
  AtomicFile::remove_unfinished();
  (void)!::write(STDERR_FILENO, message.data(), message.size());
  ::_exit(static_cast<int>(ExitCode::device_failed));
}

void on_crash(int /*number*/) {
  give_up(
      "facet: crashed, most likely in the device's driver, which happens when memory is short; "
      "files that were there before are as they were\n");
}

void on_unhandled_error() {
  give_up(
      "facet: ended by an error that nothing could handle, most likely for want of memory; files "
      "that were there before are as they were\n");
}

void catch_signal(int number) {
  // What a caller has set to be ignored, as nohup does, stays so.
  if (std::signal(number, on_signal) == SIG_IGN) (void)std::signal(number, SIG_IGN);
}

}  // namespace

void catch_interrupts() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) catch_signal(number);
}

void tell_of_crashes() {
  if (is_sanitized) return;
  // A stack of its own: the usual one may have come to its end.
  static std::array<char, 1U << 16U> stack;
  stack_t alternative{};
  alternative.ss_sp = stack.data();
  alternative.ss_size = stack.size();
  (void)::sigaltstack(&alternative, nullptr);
  struct sigaction action {};
  action.sa_handler = on_crash;
  action.sa_flags = SA_ONSTACK;
  // Libraries abort where they get no memory.
  for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL})
    (void)::sigaction(number, &action, nullptr);
  std::set_terminate(on_unhandled_error);
}

bool was_interrupted() { return interrupted != 0; }

}  // namespace facet::cli
