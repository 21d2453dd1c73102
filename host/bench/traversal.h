#pragma once
// Rays per second of the kernels, beside the yardstick's on the same rays in the same run.
#include <optional>
#include <string>
#include <vector>

#include "core/figure.h"
#include "gpu/device.h"
#include "scene/scene.h"

namespace facet::bench {

struct TraversalOptions {
  std::uint32_t rays = 1U << 18U;  ///< from the camera, about
  int repeats = 7;
};

/// One kind of rays. Figures are in millions of rays a second.
struct TraversalRow {
  std::string kind;
  std::size_t rays = 0;
  Figure facet;
  std::optional<Figure> single;   ///< the yardstick's, a ray at a time
  std::optional<Figure> packets;  ///< and by packets of eight
  /// Share of rays for which both found the same: the same distance to 1e-4 of it, or the same
  /// answer. What remains hits edges.
  double equal_hits = 1;

  /// Of the medians; 0 without a yardstick.
  [[nodiscard]] double ratio() const { return single ? facet.median / single->median : 0; }
};

struct BuildRow {
  Figure seconds;
  std::uint64_t bytes = 0;  ///< of nodes and triangles on the device
  double sah = 0;           ///< visits of nodes and leaves by a random ray, expected
  std::optional<Figure> yardstick_seconds;
  std::optional<std::uint64_t> yardstick_bytes;
};

struct TraversalResult {
  std::string mesh;
  std::size_t triangles = 0;
  BuildRow build;
  std::vector<TraversalRow> rows;
};

/// Both build their trees in turn, `repeats` times but three at most, and trace every set of rays
/// in turn, `repeats` times; the first round of each is not counted. Throws InputError where the
/// mesh does not fit the device.
[[nodiscard]] TraversalResult measure_traversal(gpu::Device& device, const std::string& name,
                                                Scene scene, const TraversalOptions& options);

}  // namespace facet::bench
