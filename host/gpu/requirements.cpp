#include "gpu/requirements.h"

#include <fmt/format.h>

#include <algorithm>

#include "shared/bindings.h"

namespace facet::gpu {

namespace {

/// That a render binds where no texel buffer is large enough: all bindings, but the one uniform
/// buffer and those of the kernels that evaluate BSDFs alone.
constexpr std::uint32_t storage_buffers = shared::BINDING_counters;

struct Requirement {
  std::string name;
  std::function<bool(const vk::raii::PhysicalDevice&)> met;
};

template <typename Value>
Requirement limit(const std::string& name, Value vk::PhysicalDeviceLimits::*member, Value least) {
  return {fmt::format("{} >= {}", name, least), [member, least](const vk::raii::PhysicalDevice& d) {
            return d.getProperties().limits.*member >= least;
          }};
}

std::vector<Requirement> requirements() {
  using Limits = vk::PhysicalDeviceLimits;
  return {
      {fmt::format("Vulkan {}", minimum_vulkan_version),
       [](const auto& d) { return d.getProperties().apiVersion >= minimum_api_version; }},
      {"a compute queue",
       [](const auto& d) { return compute_queue_family(d) != VK_QUEUE_FAMILY_IGNORED; }},
      limit<std::uint32_t>("maxPerStageDescriptorStorageBuffers",
                           &Limits::maxPerStageDescriptorStorageBuffers, storage_buffers),
      limit<std::uint32_t>("maxDescriptorSetStorageBuffers",
                           &Limits::maxDescriptorSetStorageBuffers, storage_buffers),
      limit<std::uint32_t>("maxComputeWorkGroupInvocations",
                           &Limits::maxComputeWorkGroupInvocations, shared::WORKGROUP_SIZE),
      limit<std::uint32_t>("maxStorageBufferRange", &Limits::maxStorageBufferRange, 1U << 27U),
  };
}

std::string kind_name(vk::PhysicalDeviceType type) {
  switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return "discrete GPU";
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return "integrated GPU";
    case vk::PhysicalDeviceType::eVirtualGpu:
      return "virtual GPU";
    case vk::PhysicalDeviceType::eCpu:
      return "CPU";
    default:
      return "other";
  }
}

int rank_of(vk::PhysicalDeviceType type, bool usable) {
  const int preference = type == vk::PhysicalDeviceType::eDiscreteGpu     ? 4
                         : type == vk::PhysicalDeviceType::eIntegratedGpu ? 3
                         : type == vk::PhysicalDeviceType::eVirtualGpu    ? 2
                         : type == vk::PhysicalDeviceType::eCpu           ? 1
                                                                          : 0;
  return preference + (usable ? 10 : 0);
}

}  // namespace

std::uint32_t compute_queue_family(const vk::raii::PhysicalDevice& device) {
  const auto families = device.getQueueFamilyProperties();
  const auto found =
      std::find_if(families.begin(), families.end(), [](const vk::QueueFamilyProperties& f) {
        return static_cast<bool>(f.queueFlags & vk::QueueFlagBits::eCompute);
      });
  return found == families.end() ? VK_QUEUE_FAMILY_IGNORED
                                 : static_cast<std::uint32_t>(found - families.begin());
}

DeviceInfo describe_device(const vk::raii::PhysicalDevice& device, std::uint32_t index) {
  const vk::PhysicalDeviceProperties properties = device.getProperties();
  DeviceInfo info;
  info.index = index;
  info.name = properties.deviceName.data();
  info.kind = kind_name(properties.deviceType);
  info.vulkan_version = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(properties.apiVersion),
                                    VK_API_VERSION_MINOR(properties.apiVersion),
                                    VK_API_VERSION_PATCH(properties.apiVersion));
  info.driver = fmt::format("driver version {:#x}", properties.driverVersion);
  if (properties.apiVersion >= VK_API_VERSION_1_2) {
    const auto chain =
        device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    info.driver = fmt::format("{} {}", driver.driverName.data(), driver.driverInfo.data());
  }
  const auto memory = device.getMemoryProperties();
  for (std::uint32_t h = 0; h < memory.memoryHeapCount; ++h) {
    const vk::MemoryHeap& heap = memory.memoryHeaps[h];
    if (heap.flags & vk::MemoryHeapFlagBits::eDeviceLocal)
      info.memory_bytes = std::max<std::uint64_t>(info.memory_bytes, heap.size);
  }
  for (const Requirement& requirement : requirements()) {
    if (!requirement.met(device)) info.lacks.push_back(requirement.name);
  }
  info.rank = rank_of(properties.deviceType, info.lacks.empty());
  return info;
}

std::vector<std::string> requirement_names() {
  std::vector<std::string> names;
  for (const Requirement& requirement : requirements()) names.push_back(requirement.name);
  return names;
}

}  // namespace facet::gpu
