#include "gpu/buffer.h"

#include <algorithm>
#include <cstring>

#include "core/error.h"

namespace facet::gpu {

namespace {

/// Bytes copied at a time where staging is needed.
constexpr std::uint64_t staging_bytes = 16U << 20U;

/// Every buffer holds at least one record of any kind: kernels look at the first one even where
/// they then discard it.
constexpr std::uint64_t least_bytes = 64;

vk::raii::Buffer make_buffer(const Device& device, std::uint64_t bytes,
                             vk::BufferUsageFlags usage) {
  return {device.handle(), vk::BufferCreateInfo({}, bytes, usage)};
}

}  // namespace

Buffer::Buffer(Device& device, std::uint64_t bytes, vk::BufferUsageFlags usage,
               const std::string& what)
    : device_(&device),
      size_(std::max<std::uint64_t>((bytes + 15) / 16 * 16, least_bytes)),
      buffer_(nullptr),
      memory_(nullptr) {
  using Memory = vk::MemoryPropertyFlagBits;
  const bool staging = static_cast<bool>(usage & vk::BufferUsageFlagBits::eTransferSrc);
  // Staging memory is the host's.
  if (!staging) reservation_ = device.reserve(size_, what);
  try {
    buffer_ = make_buffer(
        device, size_,
        usage | vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst);
    const vk::MemoryRequirements needs = buffer_.getMemoryRequirements();
    const std::uint32_t type =
        staging
            ? device.memory_type(needs.memoryTypeBits, Memory::eHostVisible | Memory::eHostCoherent,
                                 Memory::eHostCached)
            : device.memory_type(
                  needs.memoryTypeBits, Memory::eDeviceLocal,
                  Memory::eHostVisible | Memory::eHostCoherent | Memory::eHostCached);
    memory_ = {device.handle(), vk::MemoryAllocateInfo(needs.size, type)};
    buffer_.bindMemory(*memory_, 0);
    const auto flags = device.memory_flags(type);
    constexpr auto shared = Memory::eHostVisible | Memory::eHostCoherent;
    if ((flags & shared) == shared)
      mapped_ = static_cast<std::byte*>(memory_.mapMemory(0, VK_WHOLE_SIZE));
  } catch (const vk::SystemError& e) {
    throw DeviceError(fmt::format("{}: cannot allocate {} bytes for {}: {}", device.info().name,
                                  size_, what, e.what()));
  }
}

void Buffer::upload(std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  if (mapped_ != nullptr) {
    std::memcpy(mapped_, bytes.data(), bytes.size());
    return;
  }
  Buffer staging(*device_, std::min<std::uint64_t>(bytes.size(), staging_bytes),
                 vk::BufferUsageFlagBits::eTransferSrc, "staging");
  for (std::uint64_t at = 0; at < bytes.size(); at += staging_bytes) {
    const std::uint64_t count = std::min<std::uint64_t>(staging_bytes, bytes.size() - at);
    std::memcpy(staging.mapped_, bytes.data() + at, count);
    device_->run([&](const vk::raii::CommandBuffer& c) {
      c.copyBuffer(staging.handle(), handle(), vk::BufferCopy(0, at, count));
    });
  }
}

void Buffer::download(std::span<std::byte> bytes) const {
  if (mapped_ != nullptr) {
    std::memcpy(bytes.data(), mapped_, bytes.size());
    return;
  }
  const Buffer staging(*device_, std::min<std::uint64_t>(bytes.size(), staging_bytes),
                       vk::BufferUsageFlagBits::eTransferSrc, "staging");
  for (std::uint64_t at = 0; at < bytes.size(); at += staging_bytes) {
    const std::uint64_t count = std::min<std::uint64_t>(staging_bytes, bytes.size() - at);
    device_->run([&](const vk::raii::CommandBuffer& c) {
      c.copyBuffer(handle(), staging.handle(), vk::BufferCopy(at, 0, count));
    });
    std::memcpy(bytes.data() + at, staging.mapped_, count);
  }
}

void Buffer::clear() {
  device_->run(
      [&](const vk::raii::CommandBuffer& c) { c.fillBuffer(handle(), 0, VK_WHOLE_SIZE, 0); });
}

vk::raii::BufferView make_texel_view(const Device& device, const Buffer& buffer) {
  return {device.handle(),
          vk::BufferViewCreateInfo({}, buffer.handle(), vk::Format::eR32G32B32A32Uint, 0,
                                   VK_WHOLE_SIZE)};
}

}  // namespace facet::gpu
