#pragma once
#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace facet::gpu {

/// The oldest Vulkan version that facet runs on.
inline constexpr std::uint32_t minimum_vulkan_version = VK_API_VERSION_1_1;

}  // namespace facet::gpu
