#include "gpu/device.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/text.h"
#include "gpu/commands.h"
#include "gpu/requirements.h"
#include "gpu/vulkan.h"

namespace facet::gpu {

namespace {

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, std::uint32_t family) {
  const float priority = 1;
  const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
  std::vector<const char*> extensions;
  // A driver that offers the portability subset insists on its being enabled.
  for (const auto& e : physical.enumerateDeviceExtensionProperties()) {
    if (std::string_view(e.extensionName) == "VK_KHR_portability_subset")
      extensions.push_back("VK_KHR_portability_subset");
  }
  return {physical, vk::DeviceCreateInfo({}, queue, {}, extensions)};
}

vk::raii::CommandBuffer make_commands(const vk::raii::Device& device,
                                      const vk::raii::CommandPool& pool) {
  vk::raii::CommandBuffers buffers(
      device, vk::CommandBufferAllocateInfo(*pool, vk::CommandBufferLevel::ePrimary, 1));
  return std::move(buffers.front());
}

Device::Limits limits_of(const vk::PhysicalDeviceLimits& limits) {
  return {limits.maxStorageBufferRange, limits.maxUniformBufferRange, limits.maxTexelBufferElements,
          limits.maxPerStageDescriptorStorageImages};
}

}  // namespace

Device::Vulkan::Vulkan(Instance&& with_drivers, const DeviceInfo& info)
    : instance(std::move(with_drivers)),
      physical(instance.physical_device(info)),
      memory(physical.getMemoryProperties()),
      queue_family(compute_queue_family(physical)),
      device(make_device(physical, queue_family)),
      queue(device, queue_family, 0),
      pool(device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                             queue_family)),
      commands(make_commands(device, pool)),
      fence(device, vk::FenceCreateInfo()) {}

std::uint32_t Device::Vulkan::memory_type(std::uint32_t allowed, vk::MemoryPropertyFlags required,
                                          vk::MemoryPropertyFlags preferred,
                                          const std::string& name) const {
  for (const vk::MemoryPropertyFlags wanted : {required | preferred, required}) {
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      if ((allowed & (1U << i)) != 0 && (memory.memoryTypes[i].propertyFlags & wanted) == wanted)
        return i;
    }
  }
  throw DeviceError(fmt::format("{} has no memory of the kind {}", name, vk::to_string(required)));
}

Device::Device(const std::string& selector, bool validate) {
  Instance instance(validate);
  info_ = choose_device(instance.devices(), selector);
  vulkan_ = or_device_error(info_.name, "be opened",
                            [&] { return std::make_unique<Vulkan>(std::move(instance), info_); });
  const vk::PhysicalDeviceProperties properties = vulkan_->physical.getProperties();
  limits_ = limits_of(properties.limits);
  is_cpu_ = properties.deviceType == vk::PhysicalDeviceType::eCpu;
}

Device::~Device() = default;

std::vector<std::string> Device::validation_messages() const {
  ValidationLog& log = vulkan_->instance.validation();
  const std::scoped_lock lock(log.mutex);
  return log.messages;
}

std::uint64_t Device::free_bytes() const {
  const std::uint64_t of_heap = info_.memory_bytes - *reserved_;
  if (!is_cpu_) return of_heap;
  // A software driver's memory is the host's, whether or not the system counts it as this
  // process's.
  const std::uint64_t limit = memory_limit().value_or(info_.memory_bytes);
  return std::min(
      {of_heap, available_memory().value_or(of_heap), limit - std::min(limit, *reserved_)});
}

std::shared_ptr<void> Device::reserve(std::uint64_t bytes, const std::string& what) {
  if (bytes > free_bytes()) {
    throw InputError(
        fmt::format("{}: {}B of device memory are needed, but of the {}B of {} {}B are free", what,
                    with_unit_prefix(static_cast<double>(bytes)),
                    with_unit_prefix(static_cast<double>(info_.memory_bytes)), info_.name,
                    with_unit_prefix(static_cast<double>(free_bytes()))));
  }
  *reserved_ += bytes;
  return {nullptr, [reserved = reserved_, bytes](void*) { *reserved -= bytes; }};
}

void Device::run(const std::function<void(Commands&)>& record) {
  try {
    const vk::raii::CommandBuffer& buffer = vulkan_->commands;
    buffer.reset();
    buffer.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    Commands commands(buffer);
    record(commands);
    buffer.end();
    const vk::CommandBuffer handle = *buffer;
    vulkan_->queue.submit(vk::SubmitInfo({}, {}, handle), *vulkan_->fence);
    while (vulkan_->device.waitForFences(*vulkan_->fence, VK_TRUE, UINT64_MAX) ==
           vk::Result::eTimeout) {
    }
    vulkan_->device.resetFences(*vulkan_->fence);
  } catch (const vk::SystemError& e) {
    throw DeviceError(fmt::format("{} failed: {}", info_.name, e.what()));
  }
}

}  // namespace facet::gpu
