#pragma once
// Vulkan behind the classes of this room; for its own source files alone.
#include <mutex>
#include <string_view>
#include <vulkan/vulkan_raii.hpp>

#include "core/error.h"
#include "gpu/device.h"

namespace facet::gpu {

/// What a call returns that calls Vulkan. Throws DeviceError where Vulkan refuses: "DEVICE cannot
/// DO: ...".
template <typename Call>
auto or_device_error(const std::string& device, std::string_view what, const Call& call) {
  try {
    return call();
  } catch (const vk::SystemError& error) {
    throw DeviceError(fmt::format("{} cannot {}: {}", device, what, error.what()));
  }
}

/// What the validation layers said, in any thread that called Vulkan.
struct ValidationLog {
  std::mutex mutex;
  std::vector<std::string> messages;
};

/// The Vulkan instance, with or without validation layers.
class Instance {
 public:
  /// Throws DeviceError, saying which package to install, where there is no Vulkan loader or, with
  /// `validate`, no layers.
  explicit Instance(bool validate);

  [[nodiscard]] std::vector<DeviceInfo> devices() const;
  [[nodiscard]] vk::raii::PhysicalDevice physical_device(const DeviceInfo& info) const;
  [[nodiscard]] ValidationLog& validation() const { return *validation_; }

 private:
  std::unique_ptr<ValidationLog> validation_;
  vk::raii::Context context_;
  vk::raii::Instance instance_;
  vk::raii::DebugUtilsMessengerEXT messenger_;
};

struct Device::Vulkan {
  Instance instance;
  vk::raii::PhysicalDevice physical;
  vk::PhysicalDeviceMemoryProperties memory;
  std::uint32_t queue_family;
  vk::raii::Device device;
  vk::raii::Queue queue;
  vk::raii::CommandPool pool;
  vk::raii::CommandBuffer commands;
  vk::raii::Fence fence;

  Vulkan(Instance&& instance, const DeviceInfo& info);

  /// Index of a memory type with the properties, preferring those with `preferred` as well; throws
  /// DeviceError without one. name: of the device.
  [[nodiscard]] std::uint32_t memory_type(std::uint32_t allowed, vk::MemoryPropertyFlags required,
                                          vk::MemoryPropertyFlags preferred,
                                          const std::string& name) const;
};

}  // namespace facet::gpu
