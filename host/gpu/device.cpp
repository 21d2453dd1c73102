#include "gpu/device.h"

#include "core/error.h"
#include "core/text.h"
#include "gpu/requirements.h"

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

}  // namespace

Device::Device(const Instance& instance, DeviceInfo info)
    : info_(std::move(info)),
      physical_(instance.physical_device(info_)),
      limits_(physical_.getProperties().limits),
      memory_(physical_.getMemoryProperties()),
      is_cpu_(physical_.getProperties().deviceType == vk::PhysicalDeviceType::eCpu),
      queue_family_(compute_queue_family(physical_)),
      has_timestamps_(physical_.getQueueFamilyProperties()[queue_family_].timestampValidBits > 0),
      device_(make_device(physical_, queue_family_)),
      queue_(device_, queue_family_, 0),
      pool_(device_, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                               queue_family_)),
      commands_(make_commands(device_, pool_)),
      fence_(device_, vk::FenceCreateInfo()),
      budget_(info_.memory_bytes) {}

std::uint32_t Device::memory_type(std::uint32_t allowed, vk::MemoryPropertyFlags required,
                                  vk::MemoryPropertyFlags preferred) const {
  for (const vk::MemoryPropertyFlags wanted : {required | preferred, required}) {
    for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
      if ((allowed & (1U << i)) != 0 && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted)
        return i;
    }
  }
  throw DeviceError(
      fmt::format("{} has no memory of the kind {}", info_.name, vk::to_string(required)));
}

vk::MemoryPropertyFlags Device::memory_flags(std::uint32_t type) const {
  return memory_.memoryTypes[type].propertyFlags;
}

std::shared_ptr<void> Device::reserve(std::uint64_t bytes, const std::string& what) {
  if (*reserved_ + bytes > budget_) {
    throw InputError(fmt::format(
        "{} needs {}B of device memory, but of the {}B of {} {}B are taken: it does not fit", what,
        with_unit_prefix(static_cast<double>(bytes)),
        with_unit_prefix(static_cast<double>(budget_)), info_.name,
        with_unit_prefix(static_cast<double>(*reserved_))));
  }
  *reserved_ += bytes;
  return {nullptr, [reserved = reserved_, bytes](void*) { *reserved -= bytes; }};
}

void Device::run(const std::function<void(const vk::raii::CommandBuffer&)>& record) {
  try {
    commands_.reset();
    commands_.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    record(commands_);
    commands_.end();
    const vk::CommandBuffer buffer = *commands_;
    queue_.submit(vk::SubmitInfo({}, {}, buffer), *fence_);
    while (device_.waitForFences(*fence_, VK_TRUE, UINT64_MAX) == vk::Result::eTimeout) {
    }
    device_.resetFences(*fence_);
  } catch (const vk::SystemError& e) {
    throw DeviceError(fmt::format("{} failed: {}", info_.name, e.what()));
  }
}

}  // namespace facet::gpu
