#pragma once
// Buffers in device memory: mapped where the device shares memory with the host, staged where it
// does not.
#include <span>

#include "gpu/device.h"

namespace facet::gpu {

class Buffer {
 public:
  /// At least 64 bytes are allocated, so that an unused buffer can be bound. `what` names it in
  /// messages.
  Buffer(Device& device, std::uint64_t bytes, vk::BufferUsageFlags usage, const std::string& what);

  [[nodiscard]] vk::Buffer handle() const { return *buffer_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Copies to or from the start of the buffer and waits.
  void upload(std::span<const std::byte> bytes);
  void download(std::span<std::byte> bytes) const;
  /// Sets every byte to 0.
  void clear();

  template <typename Record>
  void upload(const std::vector<Record>& records) {
    upload(std::as_bytes(std::span(records)));
  }

 private:
  Device* device_;
  std::shared_ptr<void> reservation_;
  std::uint64_t size_;
  vk::raii::Buffer buffer_;
  vk::raii::DeviceMemory memory_;
  std::byte* mapped_ = nullptr;  ///< the whole buffer where the host sees it, else none
};

/// A uniform texel buffer's view, RGBA32UI, over the whole buffer.
[[nodiscard]] vk::raii::BufferView make_texel_view(const Device& device, const Buffer& buffer);

}  // namespace facet::gpu
