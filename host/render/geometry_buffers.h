#pragma once
// The BVH on a device, as texel buffers or, where a device's are too small, as storage buffers.
#include <vector>

#include "core/error.h"
#include "gpu/pipeline.h"
#include "render/kernels.h"
#include "render/pack/packed_scene.h"
#include "shared/bindings.h"

namespace facet {

/// Paths in flight at most: the permutation of pixels computes in 32 bits.
inline constexpr std::size_t most_slots = 1U << 21U;

/// How the state of paths is bound, which kernels write as storage and read as texels.
inline constexpr vk::BufferUsageFlags state_usage =
    vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eStorageTexelBuffer;

/// How the scene is bound.
inline vk::BufferUsageFlagBits scene_usage(GeometryFetch fetch) {
  using Usage = vk::BufferUsageFlagBits;
  return fetch == GeometryFetch::texel_buffer ? Usage::eStorageTexelBuffer : Usage::eStorageBuffer;
}

/// A buffer with these records, in whole texels; throws InputError where it is larger than the
/// device can bind.
template <typename Records>
gpu::Buffer make_record_buffer(gpu::Device& device, const Records& records, const std::string& what,
                               vk::BufferUsageFlags usage) {
  constexpr std::uint64_t texel = sizeof(glm::uvec4);
  const std::uint64_t bytes = (bytes_of(records) + texel - 1) / texel * texel;
  if ((usage & vk::BufferUsageFlagBits::eStorageBuffer) &&
      bytes > device.limits().maxStorageBufferRange) {
    throw InputError(fmt::format("{}: {} bytes are more than {} can bind ({})", what, bytes,
                                 device.info().name, device.limits().maxStorageBufferRange));
  }
  gpu::Buffer buffer(device, bytes, usage, what);
  if (records.empty()) {
    buffer.clear();
  } else {
    buffer.upload(std::as_bytes(std::span(records)));
  }
  return buffer;
}

class GeometryBuffers {
 public:
  GeometryBuffers(gpu::Device& device, const PackedScene& packed, bool force_storage_buffers);

  [[nodiscard]] GeometryFetch fetch() const { return fetch_; }
  [[nodiscard]] std::uint64_t bytes() const { return items_.size() + pairs_.size(); }
  /// Of all bindings that the kernels of a render have.
  [[nodiscard]] std::vector<vk::DescriptorType> binding_types() const;
  /// Sets the two bindings; this must outlive what is bound.
  void bind(std::vector<gpu::Binding>& bindings) const;

 private:
  GeometryFetch fetch_;
  gpu::Buffer items_;
  gpu::Buffer pairs_;
  std::vector<vk::raii::BufferView> views_;  ///< of the two, or none
};

}  // namespace facet
