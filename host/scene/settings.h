#pragma once
// What a render is asked for beyond the scene, whatever renders it.
#include <cstdint>

namespace facet {

/// How directions are sampled: rough lobes by half vectors from the NDF or from the visible normals; or, by
/// the reference alone, every BSDF by the uniform hemisphere, which needs none of its sampling code.
enum class LobeSampling { ndf, visible, uniform };

/// Pixels [x0, x1) x [y0, y1) of the image.
struct Crop {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;
};

struct RenderSettings {
  Crop crop;
  std::uint32_t first_sample = 0;  ///< samples [first, end) of each pixel
  std::uint32_t end_sample = 1;
  std::uint32_t seed = 0;
  LobeSampling sampling = LobeSampling::visible;
  bool variance = false;  ///< keep sums of squares

  // Of the kernels alone; no result depends on them.
  /// Read from storage buffers even where texel buffers would do; for tests.
  bool force_storage_buffers = false;
  /// Paths in flight, 0: chosen for the device; for tests and measurements.
  std::uint32_t paths_in_flight = 0;
  /// Measure the seconds of each stage.
  bool time_stages = false;
};

}  // namespace facet
