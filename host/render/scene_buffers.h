#pragma once
// A packed scene on a device.
#include "render/bindings.h"
#include "render/pack/packed_scene.h"

namespace facet {

/// Paths in flight at most: the permutation of pixels computes in 32 bits.
inline constexpr std::size_t most_slots = 1U << 21U;

/// Texel buffers where the device has enough of them for all that is read so, and large enough
/// ones; else storage buffers.
[[nodiscard]] GeometryFetch choose_fetch(const gpu::Device& device, const PackedScene& packed,
                                         bool force_storage_buffers);

/// What kernels read of a scene, by the shared list of bindings.
class SceneBuffers {
 public:
  /// Uploads everything. Throws InputError where it does not fit the device.
  SceneBuffers(gpu::Device& device, const PackedScene& packed);
  /// Uploads the triangles and their tree alone.
  [[nodiscard]] static SceneBuffers of_geometry(gpu::Device& device, const PackedScene& packed);

  void add_to(gpu::BufferMap& map) const;
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  SceneBuffers() = default;

  std::map<std::uint32_t, gpu::Buffer> buffers_;  ///< by binding
};

}  // namespace facet
