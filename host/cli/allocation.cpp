#include "cli/allocation.h"

#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <string_view>
#include <utility>

#include "cli/exit_code.h"
#include "core/atomic_file.h"
#include "core/memory.h"

namespace facet::cli {

namespace {

/// Whether there are words for it: not before main() begins.
std::atomic<bool> can_tell{false};
std::atomic<bool> is_ending{false};
/// Whether this thread is ending the program: its words need memory themselves.
thread_local bool is_ending_it = false;

void write_error(std::string_view text) { (void)!::write(STDERR_FILENO, text.data(), text.size()); }

[[noreturn, maybe_unused]] void end_for_want_of(std::size_t bytes) {
  // The first to be refused tells; others wait until it has.
  if (is_ending.exchange(true) && !is_ending_it) ::sleep(5);
  AtomicFile::remove_unfinished();
  if (can_tell && !std::exchange(is_ending_it, true)) {
    write_error("facet: " + describe_lack(bytes) + '\n');
  } else {
    write_error("facet: out of memory\n");
  }
  ::_exit(static_cast<int>(ExitCode::bad_input));
}

}  // namespace

void tell_of_refused_allocations() { can_tell = true; }

}  // namespace facet::cli

#ifndef __SANITIZE_ADDRESS__

namespace {

/// Systems promise more memory than they have and kill whoever then uses it, so large allocations
/// are refused here already where they exceed what is left.
void* allocate(std::size_t bytes) {
  constexpr std::size_t large = std::size_t{64} << 20U;
  if (bytes < large || bytes <= facet::available_memory().value_or(bytes)) {
    if (void* memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;  // NOLINT
  }
  facet::cli::end_for_want_of(bytes);
}

}  // namespace

void* operator new(std::size_t bytes) { return allocate(bytes); }
void* operator new[](std::size_t bytes) { return allocate(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }                 // NOLINT
void operator delete[](void* memory) noexcept { std::free(memory); }               // NOLINT
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }    // NOLINT
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }  // NOLINT

#endif
