#include "render/bindings.h"

namespace facet {

namespace {

/// Whether a state's records are read as texels, by a second binding.
bool is_aliased(std::uint32_t number, GeometryFetch fetch) {
  return fetch == GeometryFetch::texel_buffer && bindings.at(number).kind == BindingKind::state;
}

std::vector<gpu::Slot> slots_of(std::span<const std::uint32_t> numbers, GeometryFetch fetch) {
  using gpu::Access;
  std::vector<gpu::Slot> slots;
  for (const std::uint32_t number : numbers) {
    const BindingKind kind = bindings.at(number).kind;
    const bool texels = kind == BindingKind::scene && fetch == GeometryFetch::texel_buffer;
    slots.push_back({number, kind == BindingKind::uniform ? Access::uniform
                             : texels                     ? Access::texels
                                                          : Access::storage});
    if (is_aliased(number, fetch))
      slots.push_back({number + shared::BINDING_TEXELS, Access::texels});
  }
  return slots;
}

}  // namespace

KernelProgram::KernelProgram(const gpu::Device& device, std::span<const std::uint32_t> numbers,
                             GeometryFetch fetch)
    : fetch_(fetch), program_(device, slots_of(numbers, fetch), sizeof(shared::PassConstants)) {}

gpu::CompiledKernel KernelProgram::compile(
    Kernel kernel, const std::array<std::uint32_t, shared::SPEC_COUNT>& constants) const {
  return program_.compile(kernel_code(kernel, fetch_), constants, kernel_name(kernel));
}

gpu::BoundBuffers KernelProgram::bind(gpu::BufferMap buffers) const {
  const gpu::BufferMap named = buffers;
  for (const auto& [number, buffer] : named) {
    if (is_aliased(number, fetch_)) buffers[number + shared::BINDING_TEXELS] = buffer;
  }
  return program_.bind(buffers);
}

}  // namespace facet
