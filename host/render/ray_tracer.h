#pragma once
// Given rays through a packed scene's triangles, by the traversal of those that render: what
// benchmarks ask.
#include <span>
#include <vector>

#include "render/path_state.h"
#include "render/scene_buffers.h"

namespace facet {

class RayTracer {
 public:
  /// Uploads the geometry and compiles the kernels. At most most_rays can be traced at once. Throws
  /// InputError if anything does not fit the device.
  RayTracer(gpu::Device& device, const PackedScene& packed, std::uint32_t most_rays,
            bool force_storage_buffers = false);

  /// The rays of the next calls.
  void set_rays(std::span<const shared::RayRecord> rays);

  /// Finds what every ray hits, or whether anything is in its way; returns the seconds from
  /// submission to end.
  double trace_closest();
  double trace_any();

  /// What the last call found, ray by ray.
  [[nodiscard]] std::vector<shared::HitRecord> hits() const;
  [[nodiscard]] std::vector<bool> occluded() const;
  /// Rays so far whose traversal was stopped by its bound.
  [[nodiscard]] std::uint32_t bound_hits() const;

  /// Of nodes and triangles on the device.
  [[nodiscard]] std::uint64_t geometry_bytes() const { return geometry_.bytes(); }

 private:
  double run(const gpu::CompiledKernel& kernel);

  gpu::Device& device_;
  std::uint32_t ray_count_ = 0;
  SceneBuffers geometry_;
  gpu::Buffer rays_;
  gpu::Buffer hits_;
  gpu::Buffer counters_;
  KernelProgram program_;
  gpu::BoundBuffers bound_;
  gpu::CompiledKernel closest_;
  gpu::CompiledKernel any_;
};

}  // namespace facet
