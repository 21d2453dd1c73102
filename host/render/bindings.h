#pragma once
// The shared list of bindings on the host: what programs are made of.
#include <array>

#include "gpu/program.h"
#include "render/kernels.h"
#include "shared/bindings.h"
#include "shared/records.h"

namespace facet {

enum class BindingKind { scene, uniform, state, storage };

/// One line of shared/binding_list.h.
struct BindingInfo {
  std::uint32_t number;
  BindingKind kind;
  std::size_t record_bytes;
};

namespace detail {
using namespace shared;  // where the list's records have their names
inline constexpr std::array bindings{
#define FACET_INFO(number, kind, names, name, Record) \
  BindingInfo{number, BindingKind::kind, sizeof(Record)},
    FACET_BINDING_LIST(FACET_INFO)
#undef FACET_INFO
};
}  // namespace detail

/// The list; a binding's number is its index.
using detail::bindings;

/// A program whose kernels see these buffers. What they read as texels is bound so, where `fetch`
/// says.
class KernelProgram {
 public:
  KernelProgram(const gpu::Device& device, std::span<const std::uint32_t> numbers,
                GeometryFetch fetch);

  /// The kernel, specialised. Throws DeviceError.
  [[nodiscard]] gpu::CompiledKernel compile(
      Kernel kernel, const std::array<std::uint32_t, shared::SPEC_COUNT>& constants) const;
  /// Throws InputError where a buffer is larger than the device can bind.
  [[nodiscard]] gpu::BoundBuffers bind(gpu::BufferMap buffers) const;

 private:
  GeometryFetch fetch_;
  gpu::Program program_;
};

/// A buffer with these records. Throws InputError where it does not fit the device.
template <typename Records>
[[nodiscard]] gpu::Buffer make_record_buffer(gpu::Device& device, const Records& records,
                                             const std::string& what) {
  const auto bytes = std::as_bytes(std::span(records));
  gpu::Buffer buffer(device, bytes.size(), what);
  if (records.empty()) {
    buffer.clear();
  } else {
    buffer.upload(bytes);
  }
  return buffer;
}

/// Workgroups for that many invocations.
[[nodiscard]] constexpr std::uint32_t workgroups(std::uint32_t invocations) {
  return (invocations + shared::WORKGROUP_SIZE - 1) / shared::WORKGROUP_SIZE;
}

}  // namespace facet
