#include "gpu/buffer.h"

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "core/text.h"
#include "gpu/commands.h"
#include "gpu/vulkan.h"

namespace facet::gpu {

struct Buffer::Memory {
  vk::raii::Buffer buffer = nullptr;
  vk::raii::DeviceMemory memory = nullptr;
};

namespace {

/// Bytes copied at a time where staging is needed.
constexpr std::uint64_t staging_bytes = 16U << 20U;

/// Every buffer holds at least one record of any kind: kernels look at the first one even where
/// they then discard it.
constexpr std::uint64_t least_bytes = 256;

constexpr std::uint64_t texel_bytes = 16;

vk::BufferUsageFlags usage_of(bool staging) {
  using Usage = vk::BufferUsageFlagBits;
  const vk::BufferUsageFlags copied = Usage::eTransferSrc | Usage::eTransferDst;
  if (staging) return copied;
  return copied | Usage::eStorageBuffer | Usage::eStorageTexelBuffer | Usage::eUniformBuffer |
         Usage::eIndirectBuffer;
}

}  // namespace

Buffer::Buffer(Device& device, std::uint64_t bytes, const std::string& what)
    : device_(&device),
      name_(what),
      size_(std::max((bytes + texel_bytes - 1) / texel_bytes * texel_bytes, least_bytes)),
      memory_(std::make_unique<Memory>()) {
  reservation_ = device.reserve(size_, what);
  allocate(false);
}

Buffer::Buffer(Device& device, std::uint64_t bytes, Staging /*staging*/)
    : device_(&device),
      name_("staging"),
      size_(std::min(bytes, staging_bytes)),
      memory_(std::make_unique<Memory>()) {
  allocate(true);
}

Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;

void Buffer::allocate(bool staging) {
  using Property = vk::MemoryPropertyFlagBits;
  constexpr auto shared = Property::eHostVisible | Property::eHostCoherent;
  const Device::Vulkan& vulkan = device_->vulkan();
  const std::string what = fmt::format(
      "allocate {}B for {} ({}B are not booked)", with_unit_prefix(static_cast<double>(size_)),
      name_, with_unit_prefix(static_cast<double>(device_->free_bytes())));
  or_device_error(device_->info().name, what, [&] {
    memory_->buffer = {vulkan.device, vk::BufferCreateInfo({}, size_, usage_of(staging))};
    const vk::MemoryRequirements needs = memory_->buffer.getMemoryRequirements();
    const std::uint32_t type =
        staging ? vulkan.memory_type(needs.memoryTypeBits, shared, Property::eHostCached,
                                     device_->info().name)
                : vulkan.memory_type(needs.memoryTypeBits, Property::eDeviceLocal,
                                     shared | Property::eHostCached, device_->info().name);
    memory_->memory = {vulkan.device, vk::MemoryAllocateInfo(needs.size, type)};
    memory_->buffer.bindMemory(*memory_->memory, 0);
    if ((vulkan.memory.memoryTypes[type].propertyFlags & shared) == shared)
      mapped_ = static_cast<std::byte*>(memory_->memory.mapMemory(0, VK_WHOLE_SIZE));
  });
}

VkBuffer_T* Buffer::handle() const { return static_cast<VkBuffer>(*memory_->buffer); }

void Buffer::upload(std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  if (mapped_ != nullptr) {
    std::memcpy(mapped_, bytes.data(), bytes.size());
    return;
  }
  const Buffer staging(*device_, bytes.size(), Staging{});
  for (std::uint64_t at = 0; at < bytes.size(); at += staging_bytes) {
    const std::uint64_t count = std::min<std::uint64_t>(staging_bytes, bytes.size() - at);
    std::memcpy(staging.mapped_, bytes.data() + at, count);
    device_->run([&](Commands& c) { c.copy(staging, 0, *this, at, count); });
  }
}

void Buffer::download(std::span<std::byte> bytes) const {
  if (bytes.empty()) return;
  if (mapped_ != nullptr) {
    std::memcpy(bytes.data(), mapped_, bytes.size());
    return;
  }
  const Buffer staging(*device_, bytes.size(), Staging{});
  for (std::uint64_t at = 0; at < bytes.size(); at += staging_bytes) {
    const std::uint64_t count = std::min<std::uint64_t>(staging_bytes, bytes.size() - at);
    device_->run([&](Commands& c) { c.copy(*this, at, staging, 0, count); });
    std::memcpy(bytes.data() + at, staging.mapped_, count);
  }
}

void Buffer::clear() {
  device_->run([&](Commands& c) { c.fill(*this, 0, size_, 0); });
}

}  // namespace facet::gpu
