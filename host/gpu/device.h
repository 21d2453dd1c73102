#pragma once
// A Vulkan device for compute, from any driver that meets the minimum (requirements.h). No header
// of this room but vulkan.h and requirements.h shows Vulkan itself: it takes seconds to compile.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace facet::gpu {

class Commands;

/// The oldest Vulkan version that facet runs on.
inline constexpr const char* minimum_vulkan_version = "1.1";

/// One device as `facet devices` lists it.
struct DeviceInfo {
  std::uint32_t index = 0;  ///< in the order in which the loader lists them
  std::string name;
  std::string driver;              ///< name and version
  std::string kind;                ///< "discrete GPU", "CPU", ...
  std::string vulkan_version;      ///< "1.3.211"
  std::uint64_t memory_bytes = 0;  ///< largest device-local heap
  std::vector<std::string> lacks;  ///< what facet needs and the device does not have; empty: usable
  int rank = 0;                    ///< preference among usable devices, larger first
};

/// Throws DeviceError, saying which package to install, where there is no Vulkan loader or driver.
[[nodiscard]] std::vector<DeviceInfo> list_devices();

/// selector: an index, part of a name (any case), or empty for the best one. Throws DeviceError
/// where nothing fits.
[[nodiscard]] DeviceInfo choose_device(const std::vector<DeviceInfo>& devices,
                                       const std::string& selector);

/// What facet needs of a device, in words.
[[nodiscard]] std::vector<std::string> requirement_names();

/// A logical device with one compute queue.
class Device {
 public:
  /// selector: as for choose_device. validate: with the validation layers. Throws DeviceError where
  /// nothing fits or there are no layers.
  explicit Device(const std::string& selector, bool validate = false);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] const DeviceInfo& info() const { return info_; }

  struct Limits {
    std::uint64_t storage_buffer_bytes = 0;  ///< that one binding can see
    std::uint64_t uniform_buffer_bytes = 0;
    std::uint64_t texel_buffer_texels = 0;
    std::uint32_t texel_buffers = 0;  ///< that a kernel can see
  };
  [[nodiscard]] const Limits& limits() const { return limits_; }
  /// Whether this is a CPU in disguise: it wants small passes that fit into its caches.
  [[nodiscard]] bool is_cpu() const { return is_cpu_; }
  /// What the validation layers have said so far, in any thread that called Vulkan.
  [[nodiscard]] std::vector<std::string> validation_messages() const;

  /// Books memory against the device's heap; throws InputError, before anything is allocated, if it
  /// cannot fit. The booking ends with the returned object.
  [[nodiscard]] std::shared_ptr<void> reserve(std::uint64_t bytes, const std::string& what);
  [[nodiscard]] std::uint64_t reserved_bytes() const { return *reserved_; }
  /// What may still be booked.
  [[nodiscard]] std::uint64_t free_bytes() const;

  /// Records commands and waits until they have run. Throws DeviceError.
  void run(const std::function<void(Commands&)>& record);

  struct Vulkan;  ///< vulkan.h
  [[nodiscard]] const Vulkan& vulkan() const { return *vulkan_; }

 private:
  std::unique_ptr<Vulkan> vulkan_;
  DeviceInfo info_;
  Limits limits_;
  bool is_cpu_ = false;
  std::shared_ptr<std::uint64_t> reserved_ = std::make_shared<std::uint64_t>(0);  ///< booked bytes
};

}  // namespace facet::gpu
