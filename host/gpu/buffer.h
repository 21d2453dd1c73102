#pragma once
// Buffers in device memory: mapped where the device shares memory with the host, staged where it
// does not.
#include <span>

#include "gpu/device.h"

struct VkBuffer_T;

namespace facet::gpu {

/// Memory for any use: bound in any way, copied, or read for indirect dispatches.
class Buffer {
 public:
  /// More than one record is allocated in any case, in whole texels, so that an unused buffer can
  /// be bound. `what` names it in messages. Throws InputError where it does not fit into what is
  /// left of the device's memory, DeviceError where the driver refuses it.
  Buffer(Device& device, std::uint64_t bytes, const std::string& what);
  ~Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;

  [[nodiscard]] VkBuffer_T* handle() const;
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::string& name() const { return name_; }

  /// Copies to or from the start of the buffer and waits.
  void upload(std::span<const std::byte> bytes);
  void download(std::span<std::byte> bytes) const;
  /// Sets every byte to 0.
  void clear();

  template <typename Record>
  void upload(const std::vector<Record>& records) {
    upload(std::as_bytes(std::span(records)));
  }
  /// The first records.
  template <typename Record>
  [[nodiscard]] std::vector<Record> download(std::size_t count) const {
    std::vector<Record> records(count);
    download(std::as_writable_bytes(std::span(records)));
    return records;
  }

 private:
  struct Memory;
  /// Memory of the host's, from which and to which buffers are copied.
  struct Staging {};
  Buffer(Device& device, std::uint64_t bytes, Staging staging);
  void allocate(bool staging);

  Device* device_;
  std::string name_;
  std::shared_ptr<void> reservation_;
  std::uint64_t size_;
  std::unique_ptr<Memory> memory_;
  std::byte* mapped_ = nullptr;  ///< the whole buffer where the host sees it, else none
};

}  // namespace facet::gpu
