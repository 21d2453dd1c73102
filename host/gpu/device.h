#pragma once
// A Vulkan device for compute, from any driver that meets the minimum below.
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "gpu/minimum_version.h"

namespace facet::gpu {

/// One device as `facet devices` lists it.
struct DeviceInfo {
  std::uint32_t index = 0;  ///< in the order in which the loader lists them
  std::string name;
  std::string driver;  ///< name and version
  std::string kind;    ///< "discrete GPU", "CPU", ...
  std::uint32_t api_version = 0;
  std::uint64_t memory_bytes = 0;  ///< largest device-local heap
  std::vector<std::string>
      lacks;     ///< what facet needs and the device does not have, by name; empty: usable
  int rank = 0;  ///< preference among usable devices, larger first
};

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
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  [[nodiscard]] std::vector<DeviceInfo> devices() const;
  /// selector: an index, part of a name (any case), or empty for the best one. Throws DeviceError
  /// where nothing fits.
  [[nodiscard]] DeviceInfo choose(const std::string& selector) const;
  [[nodiscard]] vk::raii::PhysicalDevice physical_device(const DeviceInfo& info) const;
  [[nodiscard]] const ValidationLog& validation() const { return *validation_; }

 private:
  std::unique_ptr<ValidationLog> validation_;
  vk::raii::Context context_;
  vk::raii::Instance instance_;
  vk::raii::DebugUtilsMessengerEXT messenger_;
};

/// A logical device with one compute queue.
class Device {
 public:
  Device(const Instance& instance, DeviceInfo info);

  [[nodiscard]] const DeviceInfo& info() const { return info_; }
  [[nodiscard]] const vk::raii::Device& handle() const { return device_; }
  [[nodiscard]] const vk::PhysicalDeviceLimits& limits() const { return limits_; }
  /// Whether this is a CPU in disguise: it wants small passes that fit into its caches.
  [[nodiscard]] bool is_cpu() const { return is_cpu_; }

  /// Whether the queue can tell the time.
  [[nodiscard]] bool has_timestamps() const { return has_timestamps_; }

  /// Index of a memory type with the properties, preferring those with `preferred` as well; throws
  /// DeviceError without one.
  [[nodiscard]] std::uint32_t memory_type(std::uint32_t allowed, vk::MemoryPropertyFlags required,
                                          vk::MemoryPropertyFlags preferred) const;
  [[nodiscard]] vk::MemoryPropertyFlags memory_flags(std::uint32_t type) const;

  /// Books memory against the device's heap; throws InputError, before anything is allocated, if it
  /// cannot fit. The booking ends with the returned object.
  [[nodiscard]] std::shared_ptr<void> reserve(std::uint64_t bytes, const std::string& what);
  [[nodiscard]] std::uint64_t reserved_bytes() const { return *reserved_; }

  /// Records commands and waits until they have run.
  void run(const std::function<void(const vk::raii::CommandBuffer&)>& record);

 private:
  DeviceInfo info_;
  vk::raii::PhysicalDevice physical_;
  vk::PhysicalDeviceLimits limits_;
  vk::PhysicalDeviceMemoryProperties memory_;
  bool is_cpu_ = false;
  std::uint32_t queue_family_ = 0;
  bool has_timestamps_ = false;
  vk::raii::Device device_;
  vk::raii::Queue queue_;
  vk::raii::CommandPool pool_;
  vk::raii::CommandBuffer commands_;
  vk::raii::Fence fence_;
  std::uint64_t budget_ = 0;
  std::shared_ptr<std::uint64_t> reserved_ =
      std::make_shared<std::uint64_t>(0);  ///< bytes booked now
};

}  // namespace facet::gpu
