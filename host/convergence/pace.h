#pragma once
// How fast samples are rendered, and how many fit into a time.
#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/clock.h"

namespace facet {

/// How long samples take, and how long there is.
class Pace {
 public:
  Pace(const std::optional<Clock::time_point>& deadline, Clock::time_point now)
      : deadline_(deadline), last_(now) {}

  /// So many more samples a pixel have been rendered since the last call.
  void note(std::uint32_t samples, Clock::time_point now) {
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    all_seconds_ += seconds;
    all_samples_ += samples;
    const double average = all_seconds_ / all_samples_;
    slowest_ = std::max(seconds / samples, average);
  }
  [[nodiscard]] bool is_limited() const { return deadline_.has_value(); }
  [[nodiscard]] double seconds_left(Clock::time_point now) const {
    return std::chrono::duration<double>(*deadline_ - now).count();
  }
  [[nodiscard]] bool is_known() const { return all_samples_ > 0; }
  /// Samples a pixel that will be done by the deadline, surely, as far as the past tells.
  [[nodiscard]] std::uint32_t fitting(Clock::time_point now, double share = 1) const {
    constexpr double reserve = 0.9;
    if (all_samples_ == 0) return 0;
    const double samples = reserve * share * seconds_left(now) / slowest_;
    return static_cast<std::uint32_t>(std::clamp(samples, 0.0, 0x1p30));
  }

  /// So many samples of single pixels took so long.
  void note_pixels(double samples, Clock::duration time) {
    pixel_samples_ += samples;
    pixel_seconds_ += std::chrono::duration<double>(time).count();
  }
  /// Samples of each of so many pixels that are done within a time, and one at least: between such
  /// steps a render can be saved with as many samples in every pixel.
  [[nodiscard]] std::uint32_t step(double pixels, double seconds) const {
    if (pixel_samples_ == 0) return 1;
    const double samples = pixel_samples_ * seconds / (pixel_seconds_ * pixels);
    return static_cast<std::uint32_t>(std::clamp(samples, 1.0, 0x1p30));
  }

 private:
  std::optional<Clock::time_point> deadline_;
  Clock::time_point last_;
  double all_seconds_ = 0;
  double all_samples_ = 0;
  double slowest_ = 0;  ///< seconds a sample, of late or on average
  double pixel_samples_ = 0;
  double pixel_seconds_ = 0;
};

}  // namespace facet
