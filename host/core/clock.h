#pragma once
// Elapsed time.
#include <chrono>

namespace facet {

/// What renders and their deadlines are measured with.
using Clock = std::chrono::steady_clock;

[[nodiscard]] inline Clock::duration duration_of(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace facet
