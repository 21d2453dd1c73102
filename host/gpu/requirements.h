#pragma once
// What facet needs of a device.
#include "gpu/device.h"

namespace facet::gpu {

/// A device's description, with everything it lacks by name; unusable devices rank below all usable
/// ones.
[[nodiscard]] DeviceInfo describe_device(const vk::raii::PhysicalDevice& device,
                                         std::uint32_t index);

/// First queue family that computes, VK_QUEUE_FAMILY_IGNORED without one.
[[nodiscard]] std::uint32_t compute_queue_family(const vk::raii::PhysicalDevice& device);

/// The requirements in words, for `facet devices` and the documentation.
[[nodiscard]] std::vector<std::string> requirement_names();

}  // namespace facet::gpu
