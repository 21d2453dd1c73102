#include "cli/allocation.h"

#include <link.h>
#include <unistd.h>
#include <unwind.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string_view>

#include "cli/exit_code.h"
#include "core/atomic_file.h"
#include "core/memory.h"

namespace facet::cli {

namespace {

/// Programs and libraries that there were when main() began; 0 until then.
std::atomic<int> first_objects{0};

int count_objects() {
  int count = 0;
  ::dl_iterate_phdr(
      [](dl_phdr_info* /*info*/, std::size_t /*size*/, void* counted) {
        ++*static_cast<int*>(counted);
        return 0;
      },
      &count);
  return count;
}

/// Whether an address lies in a library that was loaded since main() began.
struct LaterSearch {
  std::uintptr_t address;
  int index = 0;
  bool found = false;
};

int look_into(dl_phdr_info* info, std::size_t /*size*/, void* data) {
  auto& search = *static_cast<LaterSearch*>(data);
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& header = info->dlpi_phdr[i];
    const std::uintptr_t begin = info->dlpi_addr + header.p_vaddr;
    if (header.p_type != PT_LOAD || search.address < begin ||
        search.address >= begin + header.p_memsz)
      continue;
    // Objects are listed in the order in which they were loaded.
    search.found = search.index >= first_objects;
    return 1;
  }
  ++search.index;
  return 0;
}

/// Whether any caller is of such a library.
bool is_called_by_later_library() {
  bool found = false;
  const auto look = [](_Unwind_Context* context, void* data) {
    LaterSearch search{_Unwind_GetIP(context)};
    ::dl_iterate_phdr(look_into, &search);
    *static_cast<bool*>(data) = search.found;
    return search.found ? _URC_END_OF_STACK : _URC_NO_REASON;
  };
  (void)_Unwind_Backtrace(look, &found);
  return found;
}

/// Allocates nothing.
[[noreturn]] void end_with(std::string_view message) {
  AtomicFile::remove_unfinished();
  (void)!::write(STDERR_FILENO, message.data(), message.size());
  ::_exit(static_cast<int>(ExitCode::device_failed));
}

[[noreturn, maybe_unused]] void refuse(std::size_t bytes) {
  if (first_objects == 0) end_with("facet: out of memory before it could begin\n");
  if (is_called_by_later_library())
    end_with(
        "facet: out of memory in the device's driver; files that were there before are as they "
        "were\n");
  throw OutOfMemory(bytes);
}

}  // namespace

void expect_refused_allocations() { first_objects = count_objects(); }

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
  facet::cli::refuse(bytes);
}

}  // namespace

void* operator new(std::size_t bytes) { return allocate(bytes); }
void* operator new[](std::size_t bytes) { return allocate(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }                 // NOLINT
void operator delete[](void* memory) noexcept { std::free(memory); }               // NOLINT
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }    // NOLINT
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }  // NOLINT

#endif
