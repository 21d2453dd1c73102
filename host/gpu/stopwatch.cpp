#include "gpu/stopwatch.h"

#include "gpu/vulkan.h"

namespace facet::gpu {

struct Stopwatch::Queries {
  vk::raii::QueryPool pool;
};

Stopwatch::Stopwatch(const Device& device, std::uint32_t most_marks) {
  const Device::Vulkan& vulkan = device.vulkan();
  const auto family = vulkan.physical.getQueueFamilyProperties()[vulkan.queue_family];
  if (family.timestampValidBits == 0) return;
  const auto nanoseconds =
      static_cast<double>(vulkan.physical.getProperties().limits.timestampPeriod);
  seconds_per_tick_ = nanoseconds * 1e-9;
  queries_ = or_device_error(device.info().name, "measure times", [&] {
    return std::make_unique<Queries>(Queries{
        {vulkan.device, vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, most_marks + 1)}});
  });
}

Stopwatch::~Stopwatch() = default;

void Stopwatch::stamp(const Commands& commands) {
  if (!queries_) return;
  const auto index = static_cast<std::uint32_t>(stages_.size());
  commands.handle().resetQueryPool(*queries_->pool, index, 1);
  commands.handle().writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *queries_->pool,
                                   index);
}

void Stopwatch::start(const Commands& commands) {
  stages_.clear();
  stamp(commands);
}

void Stopwatch::mark(const Commands& commands, std::size_t stage) {
  stages_.push_back(stage);
  stamp(commands);
}

void Stopwatch::collect(std::span<double> seconds) {
  if (!queries_ || stages_.empty()) return;
  const std::size_t count = stages_.size() + 1;
  const auto [result, ticks] = or_device_error("the device", "tell times", [&] {
    return queries_->pool.getResults<std::uint64_t>(
        0, static_cast<std::uint32_t>(count), count * sizeof(std::uint64_t), sizeof(std::uint64_t),
        vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
  });
  if (result != vk::Result::eSuccess) return;
  for (std::size_t i = 0; i < stages_.size(); ++i)
    seconds[stages_[i]] += static_cast<double>(ticks[i + 1] - ticks[i]) * seconds_per_tick_;
}

}  // namespace facet::gpu
