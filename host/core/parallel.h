#pragma once
// Work on all cores.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "core/memory.h"

namespace facet {

/// Number of threads that parallel work uses.
inline std::size_t thread_count() { return std::max(1U, std::thread::hardware_concurrency()); }

/// Calls body(begin, end) on ranges of at most `grain` that cover [0, count), on all cores; the
/// caller takes part. The first exception is rethrown when all threads have stopped.
template <typename Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
  const std::size_t chunks = (count + grain - 1) / grain;
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    for (std::size_t c = next++; c < chunks; c = next++) {
      try {
        body(c * grain, std::min(count, (c + 1) * grain));
      } catch (...) {
        const std::scoped_lock lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        next = chunks;
      }
    }
  };
  std::vector<std::jthread> threads;
  const Activity* activity = Activity::innermost();
  for (std::size_t i = 1; i < std::min(thread_count(), chunks); ++i) {
    // Where there can be no more threads, fewer do it.
    try {
      threads.emplace_back([&work, activity] {
        Activity::adopt(activity);
        work();
      });
    } catch (const std::system_error&) {
      break;
    }
  }
  work();
  threads.clear();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace facet
