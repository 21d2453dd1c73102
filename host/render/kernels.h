#pragma once
// The compiled kernels, embedded by the build.
#include <cstdint>
#include <span>

namespace facet {

enum class Kernel { generate, extend, shade, shadow, schedule, film, evaluate, sample };
inline constexpr int kernel_count = 8;
/// The first ones: those that render. The others evaluate one BSDF alone.
inline constexpr int render_kernel_count = 6;

/// How geometry and records are read: the kernels' one build variant.
enum class GeometryFetch { texel_buffer, storage_buffer };

/// SPIR-V words.
[[nodiscard]] std::span<const std::uint32_t> kernel_code(Kernel kernel, GeometryFetch fetch);

[[nodiscard]] const char* kernel_name(Kernel kernel);

}  // namespace facet
