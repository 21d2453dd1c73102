#pragma once
// The compiled kernels, embedded by the build.
#include <cstdint>
#include <span>

namespace facet {

/// Those that render; that trace given rays; that evaluate one BSDF alone; that compute with given
/// numbers.
enum class Kernel {
  bounce,
  schedule,
  film,
  camera,
  closest,
  any,
  evaluate,
  sample,
  arithmetic,
  functions
};
inline constexpr int kernel_count = 10;

/// How geometry and records are read: the kernels' one build variant.
enum class GeometryFetch { texel_buffer, storage_buffer };

/// SPIR-V words.
[[nodiscard]] std::span<const std::uint32_t> kernel_code(Kernel kernel, GeometryFetch fetch);

[[nodiscard]] const char* kernel_name(Kernel kernel);

}  // namespace facet
