#include "gpu/stopwatch.h"

namespace facet::gpu {

Stopwatch::Stopwatch(const Device& device, std::uint32_t most_marks)
    : seconds_per_tick_(device.has_timestamps()
                            ? static_cast<double>(device.limits().timestampPeriod) * 1e-9
                            : 0),
      pool_(device.handle(),
            vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, most_marks + 1)) {}

void Stopwatch::stamp(const vk::raii::CommandBuffer& commands) {
  if (seconds_per_tick_ == 0) return;
  commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *pool_,
                          static_cast<std::uint32_t>(stages_.size()));
}

void Stopwatch::start(const vk::raii::CommandBuffer& commands) {
  stages_.clear();
  if (seconds_per_tick_ != 0) commands.resetQueryPool(*pool_, 0, 1);
  stamp(commands);
}

void Stopwatch::mark(const vk::raii::CommandBuffer& commands, std::size_t stage) {
  stages_.push_back(stage);
  if (seconds_per_tick_ != 0)
    commands.resetQueryPool(*pool_, static_cast<std::uint32_t>(stages_.size()), 1);
  stamp(commands);
}

void Stopwatch::collect(std::span<double> seconds) {
  if (seconds_per_tick_ == 0 || stages_.empty()) return;
  const std::size_t count = stages_.size() + 1;
  const auto [result, ticks] = pool_.getResults<std::uint64_t>(
      0, static_cast<std::uint32_t>(count), count * sizeof(std::uint64_t), sizeof(std::uint64_t),
      vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
  if (result != vk::Result::eSuccess) return;
  for (std::size_t i = 0; i < stages_.size(); ++i)
    seconds[stages_[i]] += static_cast<double>(ticks[i + 1] - ticks[i]) * seconds_per_tick_;
}

}  // namespace facet::gpu
