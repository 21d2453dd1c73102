#include "render/kernel_store.h"

#include <algorithm>
#include <numeric>

namespace facet {

namespace {

/// Some megabytes each on lavapipe.
constexpr std::size_t most_entries = 64;

/// All bindings but those of the kernels that evaluate BSDFs alone.
std::vector<std::uint32_t> render_bindings() {
  std::vector<std::uint32_t> numbers(shared::BINDING_counters + 1);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

}  // namespace

RenderProgram::RenderProgram(const gpu::Device& device, GeometryFetch fetch,
                             const Features& features, std::uint32_t stack_size)
    : program(device, render_bindings(), fetch), kernels(program, features, stack_size) {}

std::shared_ptr<RenderProgram> KernelStore::find_or_make(const gpu::Device& device,
                                                         GeometryFetch fetch,
                                                         const Features& features,
                                                         std::uint32_t stack_size) {
  const Key key{fetch, features.integrator.interaction_limit(), features.constants(stack_size)};
  const auto found =
      std::ranges::find_if(entries_, [&](const Entry& entry) { return entry.key == key; });
  if (found != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, found);
  } else {
    entries_.push_front(
        {key, std::make_shared<RenderProgram>(device, fetch, features, stack_size)});
    if (entries_.size() > most_entries) entries_.pop_back();
  }
  return entries_.front().program;
}

}  // namespace facet
