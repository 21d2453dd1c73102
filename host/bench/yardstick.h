#pragma once
// Another ray tracer to compare with: Embree, where the build found it.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/pack/packed_scene.h"

namespace facet::bench {

/// Traces on all cores.
class Yardstick {
 public:
  virtual ~Yardstick() = default;

  /// One ray at a time, or packets of eight.
  enum class Calls { single, packets };

  /// Distances in lengths of the rays' directions, infinite for misses.
  virtual void trace_closest(std::span<const shared::RayRecord> rays, Calls calls,
                             std::span<float> distances) = 0;
  /// 1 where something is in the way; not bool, so that threads may write side by side.
  virtual void trace_any(std::span<const shared::RayRecord> rays, Calls calls,
                         std::span<char> occluded) = 0;

  /// Builds the tree anew; returns the seconds that it took.
  virtual double build() = 0;
  /// Of the tree, the triangles in its leaves included.
  [[nodiscard]] virtual std::uint64_t bytes() const = 0;
};

/// "Embree 3.13.5", or "" where there is none.
[[nodiscard]] std::string yardstick_name();

/// Its tree is built; nothing where there is none.
[[nodiscard]] std::unique_ptr<Yardstick> make_yardstick(const PackedScene& packed);

}  // namespace facet::bench
