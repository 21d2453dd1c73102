#include "render/scene_buffers.h"

#include <algorithm>

namespace facet {

namespace {

std::string what_of(const char* name) {
  std::string what = std::string("the scene's ") + name;
  std::replace(what.begin(), what.end(), '_', ' ');
  return what;
}

/// Calls body(number, name, records) for every array of the scene.
template <typename Body>
void for_each_array(const PackedScene& packed, const Body& body) {
#define FACET_CALL_scene(number, names) body(shared::BINDING_##names, #names, packed.names);
#define FACET_CALL_uniform(number, names)
#define FACET_CALL_state(number, names)
#define FACET_CALL_storage(number, names)
#define FACET_CALL(number, kind, names, name, Record) FACET_CALL_##kind(number, names)
  FACET_BINDING_LIST(FACET_CALL)
#undef FACET_CALL
#undef FACET_CALL_storage
#undef FACET_CALL_state
#undef FACET_CALL_uniform
#undef FACET_CALL_scene
}

}  // namespace

GeometryFetch choose_fetch(const gpu::Device& device, const PackedScene& packed,
                           bool force_storage_buffers) {
  std::size_t bytes = 0;
  std::uint32_t count = 0;
  for_each_array(packed, [&](std::uint32_t, const char*, const auto& records) {
    bytes = std::max(bytes, bytes_of(records));
    ++count;
  });
  for (const BindingInfo& binding : bindings) {
    if (binding.kind != BindingKind::state) continue;
    bytes = std::max(bytes, most_slots * binding.record_bytes);
    ++count;
  }
  const bool fits = bytes / sizeof(glm::uvec4) <= device.limits().texel_buffer_texels &&
                    count <= device.limits().texel_buffers;
  return fits && !force_storage_buffers ? GeometryFetch::texel_buffer
                                        : GeometryFetch::storage_buffer;
}

SceneBuffers::SceneBuffers(gpu::Device& device, const PackedScene& packed) {
  for_each_array(packed, [&](std::uint32_t number, const char* name, const auto& records) {
    buffers_.emplace(number, make_record_buffer(device, records, what_of(name)));
  });
  buffers_.emplace(shared::BINDING_frames,
                   make_record_buffer(device, std::vector{packed.frame}, "the frame"));
}

SceneBuffers SceneBuffers::of_geometry(gpu::Device& device, const PackedScene& packed) {
  SceneBuffers geometry;
  geometry.buffers_.emplace(shared::BINDING_items,
                            make_record_buffer(device, packed.items, what_of("items")));
  geometry.buffers_.emplace(shared::BINDING_pairs,
                            make_record_buffer(device, packed.pairs, what_of("pairs")));
  return geometry;
}

void SceneBuffers::add_to(gpu::BufferMap& map) const {
  for (const auto& [number, buffer] : buffers_) map[number] = &buffer;
}

std::uint64_t SceneBuffers::bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& [number, buffer] : buffers_) bytes += buffer.size();
  return bytes;
}

}  // namespace facet
