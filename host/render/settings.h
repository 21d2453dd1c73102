#pragma once
// What a render is asked for beyond the scene.
#include <cstdint>

namespace facet {

/// How half vectors of rough lobes are sampled.
enum class LobeSampling { ndf, visible };

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
  /// Fetch geometry from storage buffers even where texel buffers would do; for tests.
  bool force_storage_buffers = false;
  /// Paths in flight, 0: chosen for the device. No result depends on it; for tests and measurements.
  std::uint32_t paths_in_flight = 0;
};

}  // namespace facet
