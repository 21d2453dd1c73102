#include "render/geometry_buffers.h"

#include <algorithm>

namespace facet {

namespace {

/// Texel buffers where the device has enough of them for all that is read so, and large enough ones.
GeometryFetch choose_fetch(const gpu::Device& device, const PackedScene& packed, bool force_storage_buffers) {
  const std::size_t texels = std::max({packed.bvh.nodes.size() * sizeof(shared::BvhNode),
                                       packed.triangles.size() * sizeof(shared::TriangleRecord),
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
      nodes_(make_record_buffer(device, packed.bvh.nodes, "the BVH", usage_of(fetch_))),
      triangles_(make_record_buffer(device, packed.triangles, "the triangles", usage_of(fetch_))) {
  if (fetch_ != GeometryFetch::texel_buffer) return;
  views_.push_back(gpu::make_texel_view(device, nodes_));
  views_.push_back(gpu::make_texel_view(device, triangles_));
}

std::vector<vk::DescriptorType> GeometryBuffers::binding_types() const {
  std::vector<vk::DescriptorType> types(shared::BUFFER_BINDING_COUNT, vk::DescriptorType::eStorageBuffer);
  types[shared::BINDING_FRAME] = vk::DescriptorType::eUniformBuffer;
  if (fetch_ == GeometryFetch::texel_buffer) {
    types[shared::BINDING_NODES] = vk::DescriptorType::eStorageTexelBuffer;
    types[shared::BINDING_TRIANGLES] = vk::DescriptorType::eStorageTexelBuffer;
    types.resize(shared::BINDING_COUNT, vk::DescriptorType::eStorageTexelBuffer);
  }
  return types;
}

void GeometryBuffers::bind(std::vector<gpu::Binding>& bindings) const {
  bindings[shared::BINDING_NODES].buffer = &nodes_;
  bindings[shared::BINDING_TRIANGLES].buffer = &triangles_;
  if (views_.empty()) return;
  bindings[shared::BINDING_NODES].view = &views_[0];
  bindings[shared::BINDING_TRIANGLES].view = &views_[1];
}

}  // namespace facet
