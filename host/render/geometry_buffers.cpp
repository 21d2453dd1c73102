#include "render/geometry_buffers.h"

#include <algorithm>

namespace facet {

namespace {

/// Texel buffers where the device has enough of them for all that is read so, and large enough
/// ones.
GeometryFetch choose_fetch(const gpu::Device& device, const PackedScene& packed,
                           bool force_storage_buffers) {
  const std::size_t texels =
      std::max(
          {bytes_of(packed.bvh.items), bytes_of(packed.bvh.pairs), bytes_of(packed.normal_indices),
           bytes_of(packed.normals), bytes_of(packed.texcoord_indices), bytes_of(packed.texcoords),
           bytes_of(packed.texels), bytes_of(packed.environment.texels),
           bytes_of(packed.emitter_triangles), bytes_of(packed.emitters), bytes_of(packed.bsdfs),
           bytes_of(packed.meshes), most_slots * sizeof(shared::PathRecord)}) /
      sizeof(glm::uvec4);
  constexpr std::uint32_t images =
      shared::SCENE_BINDING_COUNT + shared::BINDING_COUNT - shared::BINDING_RAY_TEXELS;
  const bool fits = texels <= device.limits().maxTexelBufferElements &&
                    images <= device.limits().maxPerStageDescriptorStorageImages;
  return fits && !force_storage_buffers ? GeometryFetch::texel_buffer
                                        : GeometryFetch::storage_buffer;
}

}  // namespace

GeometryBuffers::GeometryBuffers(gpu::Device& device, const PackedScene& packed,
                                 bool force_storage_buffers)
    : fetch_(choose_fetch(device, packed, force_storage_buffers)),
      items_(make_record_buffer(device, packed.bvh.items, "the BVH", scene_usage(fetch_))),
      pairs_(make_record_buffer(device, packed.bvh.pairs, "the triangles' names",
                                scene_usage(fetch_))) {
  if (fetch_ != GeometryFetch::texel_buffer) return;
  views_.push_back(gpu::make_texel_view(device, items_));
  views_.push_back(gpu::make_texel_view(device, pairs_));
}

std::vector<vk::DescriptorType> GeometryBuffers::binding_types() const {
  std::vector<vk::DescriptorType> types(shared::BUFFER_BINDING_COUNT,
                                        vk::DescriptorType::eStorageBuffer);
  types[shared::BINDING_FRAME] = vk::DescriptorType::eUniformBuffer;
  if (fetch_ == GeometryFetch::texel_buffer) {
    std::fill_n(types.begin(), shared::SCENE_BINDING_COUNT,
                vk::DescriptorType::eStorageTexelBuffer);
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
