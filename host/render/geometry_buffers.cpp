#include "render/geometry_buffers.h"

#include <algorithm>

namespace facet {

namespace {

/// Texel buffers where the device has enough of them for all that is read so, and large enough ones.
GeometryFetch choose_fetch(const gpu::Device& device, const PackedScene& packed, bool force_storage_buffers) {
  const std::size_t texels = std::max({packed.bvh.items.size() * sizeof(shared::BvhItem),
                                       packed.bsdfs.size() * sizeof(shared::BsdfRecord),
                                       packed.emitters.size() * sizeof(shared::EmitterRecord),
                                       packed.meshes.size() * sizeof(shared::MeshRecord),
                                       most_slots * sizeof(shared::ShadowRayRecord)}) /
                             sizeof(glm::uvec4);
  constexpr std::uint32_t images = 2 + shared::BINDING_COUNT - shared::BINDING_RAY_TEXELS;
  const bool fits = texels <= device.limits().maxTexelBufferElements &&
                    images <= device.limits().maxPerStageDescriptorStorageImages;
  return fits && !force_storage_buffers ? GeometryFetch::texel_buffer : GeometryFetch::storage_buffer;
}

vk::BufferUsageFlagBits usage_of(GeometryFetch fetch) {
  using Usage = vk::BufferUsageFlagBits;
  return fetch == GeometryFetch::texel_buffer ? Usage::eStorageTexelBuffer : Usage::eStorageBuffer;
}

}  // namespace

GeometryBuffers::GeometryBuffers(gpu::Device& device, const PackedScene& packed, bool force_storage_buffers)
    : fetch_(choose_fetch(device, packed, force_storage_buffers)),
      items_(make_record_buffer(device, packed.bvh.items, "the BVH", usage_of(fetch_))),
      pairs_(make_record_buffer(device, packed.bvh.pairs, "the triangles' names", usage_of(fetch_))) {
  if (fetch_ != GeometryFetch::texel_buffer) return;
  views_.push_back(gpu::make_texel_view(device, items_));
  views_.push_back(gpu::make_texel_view(device, pairs_));
}

std::vector<vk::DescriptorType> GeometryBuffers::binding_types() const {
  std::vector<vk::DescriptorType> types(shared::BUFFER_BINDING_COUNT, vk::DescriptorType::eStorageBuffer);
  types[shared::BINDING_FRAME] = vk::DescriptorType::eUniformBuffer;
  if (fetch_ == GeometryFetch::texel_buffer) {
    types[shared::BINDING_BVH] = vk::DescriptorType::eStorageTexelBuffer;
    types[shared::BINDING_PAIRS] = vk::DescriptorType::eStorageTexelBuffer;
    types.resize(shared::BINDING_COUNT, vk::DescriptorType::eStorageTexelBuffer);
  }
  return types;
}

void GeometryBuffers::bind(std::vector<gpu::Binding>& bindings) const {
  const bool texels = !views_.empty();
  bindings[shared::BINDING_BVH] = {&items_, texels ? &views_[0] : nullptr};
  bindings[shared::BINDING_PAIRS] = {&pairs_, texels ? &views_[1] : nullptr};
}

}  // namespace facet
