#pragma once
// Where the time of a submission goes: the device's own timestamps between its commands.
#include <span>
#include <vector>

#include "gpu/device.h"

namespace facet::gpu {

/// Time stages of one submission at a time. Where the device's queue has no timestamps, all times
/// are 0.
class Stopwatch {
 public:
  /// most_marks: of one submission.
  Stopwatch(const Device& device, std::uint32_t most_marks);

  /// Starts a submission.
  void start(const vk::raii::CommandBuffer& commands);
  /// What was recorded since the last mark belongs to the stage.
  void mark(const vk::raii::CommandBuffer& commands, std::size_t stage);
  /// After the submission has run: adds its seconds, by stage.
  void collect(std::span<double> seconds);

 private:
  void stamp(const vk::raii::CommandBuffer& commands);

  double seconds_per_tick_;
  vk::raii::QueryPool pool_;
  std::vector<std::size_t> stages_;
};

}  // namespace facet::gpu
