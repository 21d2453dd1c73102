#pragma once
// Where the time of a submission goes: the device's own timestamps between its commands.
#include <span>
#include <vector>

#include "gpu/commands.h"

namespace facet::gpu {

/// Time stages of one submission at a time. Where the device's queue has no timestamps, all times
/// are 0.
class Stopwatch {
 public:
  /// most_marks: of one submission.
  Stopwatch(const Device& device, std::uint32_t most_marks);
  ~Stopwatch();
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

  /// Starts a submission.
  void start(const Commands& commands);
  /// What was recorded since the last mark belongs to the stage.
  void mark(const Commands& commands, std::size_t stage);
  /// After the submission has run: adds its seconds, by stage.
  void collect(std::span<double> seconds);

 private:
  struct Queries;
  void stamp(const Commands& commands);

  double seconds_per_tick_ = 0;
  std::unique_ptr<Queries> queries_;
  std::vector<std::size_t> stages_;
};

}  // namespace facet::gpu
