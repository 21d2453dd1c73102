#include "render/path_state.h"

#include <algorithm>

#include "gpu/commands.h"
#include "render/scene_buffers.h"

namespace facet {

namespace {

/// Paths in flight. Measured on lavapipe: 2^16 and 2^20 are both slower by a tenth and more; GPUs
/// need more to be busy.
constexpr std::uint32_t slots_on_cpu = 1U << 18U;
constexpr std::uint32_t slots_on_gpu = 1U << 20U;

gpu::Buffer make_state(gpu::Device& device, std::uint64_t records, std::uint32_t binding) {
  return {device, records * bindings.at(binding).record_bytes, "the paths in flight"};
}

}  // namespace

std::uint32_t choose_slots(const gpu::Device& device, const RenderSettings& settings) {
  std::uint32_t slots = settings.paths_in_flight;
  if (slots == 0) slots = device.is_cpu() ? slots_on_cpu : slots_on_gpu;
  // The largest record of a path must be bindable.
  const std::uint64_t bindable = device.limits().storage_buffer_bytes / sizeof(shared::RayRecord);
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>({slots, settings.total_samples(), most_slots, bindable}));
}

PathState::PathState(gpu::Device& device, std::uint32_t slots, bool keeps_hits)
    : slots_(slots),
      rays_(make_state(device, slots, shared::BINDING_rays)),
      hits_(make_state(device, keeps_hits ? slots : 0, shared::BINDING_hits)),
      paths_(make_state(device, slots, shared::BINDING_paths)),
      queues_(make_state(device, std::uint64_t{slots} * 2, shared::BINDING_queues)),
      counters_(make_state(device, shared::COUNTER_WORDS, shared::BINDING_counters)) {}

void PathState::add_to(gpu::BufferMap& map) const {
  map[shared::BINDING_rays] = &rays_;
  map[shared::BINDING_hits] = &hits_;
  map[shared::BINDING_paths] = &paths_;
  map[shared::BINDING_queues] = &queues_;
  map[shared::BINDING_counters] = &counters_;
}

void PathState::clear_counters(gpu::Commands& commands, std::uint32_t queued) const {
  constexpr std::uint64_t word = sizeof(std::uint32_t);
  commands.fill(counters_, 0, counters_.size(), 0);
  commands.fill(counters_, shared::COUNTER_ACTIVE * word, word, queued);
}

Counters PathState::read_counters() const {
  Counters words{};
  counters_.download(std::as_writable_bytes(std::span(words)));
  return words;
}

std::vector<shared::RayRecord> PathState::read_rays(std::uint32_t count) const {
  return rays_.download<shared::RayRecord>(count);
}

std::vector<shared::PathRecord> PathState::read_paths(std::uint32_t count) const {
  return paths_.download<shared::PathRecord>(count);
}

}  // namespace facet
