// Preloaded into the program (LD_PRELOAD): lets one of its own calls of the system fail. Calls of
// its libraries are neither counted nor touched, but those of `operator new`, which is the
// program's own.
//
// HOW: for `realtime` and `monotonic` seconds by which the clock jumps at that call; for the others
// an errno, or "kill" (the program is killed before the call); for `write` also "short" (one byte
// is written).
#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <ctime>

#include "fault.h"

namespace {

using facet::faults::Counter;

enum Call : std::size_t {
  malloc_call,
  write_call,
  open_call,
  fsync_call,
  linkat_call,
  rename_call,
  close_call,
  thread_call,
  realtime_call,
  monotonic_call,
  call_count
};

constinit std::array<Counter, call_count> counters{
    Counter("malloc"),   Counter("write"),    Counter("open"),  Counter("fsync"),
    Counter("linkat"),   Counter("rename"),   Counter("close"), Counter("thread"),
    Counter("realtime"), Counter("monotonic")};

[[gnu::destructor]] void write_all() { facet::faults::write_counts(counters); }

/// Where the program's own code lies.
struct Range {
  std::uintptr_t begin = 0;
  std::uintptr_t end = 0;
};

Range find_program() {
  Range range;
  // The first object is the program.
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t /*size*/, void* data) {
        auto& found = *static_cast<Range*>(data);
        for (int i = 0; i < info->dlpi_phnum; ++i) {
          const auto& header = info->dlpi_phdr[i];
          if (header.p_type != PT_LOAD || (header.p_flags & PF_X) == 0) continue;
          found.begin = info->dlpi_addr + header.p_vaddr;
          found.end = found.begin + header.p_memsz;
        }
        return 1;
      },
      &range);
  return range;
}

bool is_program(const void* caller) {
  static const Range program = find_program();
  const auto address = reinterpret_cast<std::uintptr_t>(caller);
  return address >= program.begin && address < program.end;
}

/// HOW the call is to fail, null if not.
const char* fault_of(Call call, const void* caller) {
  return is_program(caller) ? counters[call].next() : nullptr;
}

/// Sets errno; -1.
int refuse(const char* how, int usual) {
  if (std::strcmp(how, "kill") == 0) (void)::kill(::getpid(), SIGKILL);
  errno = *how != '\0' ? std::atoi(how) : usual;
  return -1;
}

template <typename Function>
Function* next_of(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

#define CALLER __builtin_return_address(0)

extern "C" {

void* __libc_malloc(std::size_t);  // NOLINT: glibc's name

void* malloc(std::size_t bytes) {
  if (fault_of(malloc_call, CALLER) != nullptr) {
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_malloc(bytes);
}

ssize_t write(int descriptor, const void* data, std::size_t bytes) {
  static auto* const next = next_of<decltype(write)>("write");
  if (const char* how = fault_of(write_call, CALLER)) {
    if (std::strcmp(how, "short") == 0) return next(descriptor, data, bytes > 0 ? 1 : 0);
    return refuse(how, ENOSPC);
  }
  return next(descriptor, data, bytes);
}

// Programs call one or the other, by the size of a file's positions.
#define DEFINE_OPEN(name)                                                                \
  int name(const char* path, int flags, ...) {                                           \
    static auto* const next = next_of<int(const char*, int, mode_t)>(#name);             \
    if (const char* how = fault_of(open_call, CALLER)) return refuse(how, EMFILE);       \
    va_list list;                                                                        \
    va_start(list, flags);                                                               \
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(list, mode_t) : 0; \
    va_end(list);                                                                        \
    return next(path, flags, mode);                                                      \
  }
DEFINE_OPEN(open)
DEFINE_OPEN(open64)
#undef DEFINE_OPEN

int fsync(int descriptor) {
  static auto* const next = next_of<decltype(fsync)>("fsync");
  if (const char* how = fault_of(fsync_call, CALLER)) return refuse(how, EIO);
  return next(descriptor);
}

int linkat(int from, const char* source, int to, const char* target, int flags) {
  static auto* const next = next_of<decltype(linkat)>("linkat");
  if (const char* how = fault_of(linkat_call, CALLER)) return refuse(how, EACCES);
  return next(from, source, to, target, flags);
}

int rename(const char* from, const char* to) noexcept {
  static auto* const next = next_of<int(const char*, const char*)>("rename");
  if (const char* how = fault_of(rename_call, CALLER)) return refuse(how, EACCES);
  return next(from, to);
}

int close(int descriptor) {
  static auto* const next = next_of<decltype(close)>("close");
  const char* how = fault_of(close_call, CALLER);
  const int result = next(descriptor);
  return how != nullptr ? refuse(how, EIO) : result;
}

/// Threads are started by the C++ library on the program's behalf.
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                   void* argument) noexcept {
  static auto* const next =
      next_of<int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>("pthread_create");
  if (counters[thread_call].next() != nullptr) return EAGAIN;
  return next(thread, attributes, run, argument);
}

/// Clocks are read by the C++ library on the program's behalf.
int clock_gettime(clockid_t clock, timespec* time) noexcept {
  static auto* const next = next_of<int(clockid_t, timespec*)>("clock_gettime");
  static std::atomic<long> jumped[2];
  const int result = next(clock, time);
  if (clock != CLOCK_REALTIME && clock != CLOCK_MONOTONIC) return result;
  const std::size_t which = clock == CLOCK_REALTIME ? 0 : 1;
  if (const char* how = counters[realtime_call + which].next()) jumped[which] = std::atol(how);
  time->tv_sec += jumped[which];
  return result;
}

}  // extern "C"
