#pragma once
// The paths in flight on a device.
#include "render/bindings.h"
#include "scene/settings.h"

namespace facet {

/// Paths that fit the device and the settings: many, so that it is busy.
[[nodiscard]] std::uint32_t choose_slots(const gpu::Device& device, const RenderSettings& settings);

using Counters = std::array<std::uint32_t, shared::COUNTER_WORDS>;

/// Rays, hits and paths by slot, the queues of slots, and the counters.
class PathState {
 public:
  /// keeps_hits: hits are kept between the rounds of a bounce, instead of in registers.
  PathState(gpu::Device& device, std::uint32_t slots, bool keeps_hits);

  void add_to(gpu::BufferMap& map) const;
  [[nodiscard]] std::uint32_t slots() const { return slots_; }
  [[nodiscard]] const gpu::Buffer& counters() const { return counters_; }

  /// Sets all counters to 0 but that of the first queue, which holds the slots in order after the
  /// first bounce.
  void clear_counters(gpu::Commands& commands, std::uint32_t queued) const;

  [[nodiscard]] Counters read_counters() const;
  [[nodiscard]] std::vector<shared::RayRecord> read_rays(std::uint32_t count) const;
  [[nodiscard]] std::vector<shared::PathRecord> read_paths(std::uint32_t count) const;

 private:
  std::uint32_t slots_;
  gpu::Buffer rays_;
  gpu::Buffer hits_;
  gpu::Buffer paths_;
  gpu::Buffer queues_;
  gpu::Buffer counters_;
};

}  // namespace facet
