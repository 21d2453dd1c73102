#pragma once
// What facet needs of a device; for this room's source files alone.
#include "gpu/vulkan.h"

namespace facet::gpu {

/// minimum_vulkan_version, as Vulkan writes it.
inline constexpr std::uint32_t minimum_api_version = VK_API_VERSION_1_1;

/// A device's description, with everything it lacks by name; unusable devices rank below all usable
/// ones.
[[nodiscard]] DeviceInfo describe_device(const vk::raii::PhysicalDevice& device,
                                         std::uint32_t index);

/// First queue family that computes, VK_QUEUE_FAMILY_IGNORED without one.
[[nodiscard]] std::uint32_t compute_queue_family(const vk::raii::PhysicalDevice& device);

}  // namespace facet::gpu
