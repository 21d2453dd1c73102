#pragma once
// Functions of kernels in place of their calls, where that does not make kernels much longer.
#include <cstdint>
#include <vector>

namespace facet {

/// A SPIR-V module with one entry point whose functions stand in place of their calls: those called
/// once, and those whose further copies have at most 500 words together. Drivers inline all of them
/// anyway. But GLSL's parameters are pointers, and what they point to is memory for drivers until
/// they have found that it need not be, which takes Mesa more than half of its time; and constants
/// are not followed through memory (host/gpu/specialise.h). With every function inlined, kernels
/// are six times as long before they are specialised, and start no sooner. Throws
/// std::runtime_error where there is no entry point, or SPIRV-Tools fails.
[[nodiscard]] std::vector<std::uint32_t> inline_functions(const std::vector<std::uint32_t>& module);

}  // namespace facet
