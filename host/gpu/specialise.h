#pragma once
// Specialization of kernels ahead of the driver.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace facet::gpu {

/// The SPIR-V with its specialization constants (32 bits each, ids from 0) fixed, and without the
/// functions, blocks and values that they leave no use for. Drivers do as much, but first inline
/// and rework all of a kernel: Mesa takes ten times as long. No operation that is left differs from
/// what it was. Throws DeviceError where the code is none or of an unexpected form, and trusts it
/// to be valid otherwise; `name` is for that message.
///
/// Conditions are followed within functions, through values but not through variables: the build
/// turns the ones into the others where it can, and inlines functions whose parameters are in the
/// way (cmake/generators/embed_kernels.cpp).
[[nodiscard]] std::vector<std::uint32_t> specialise(std::span<const std::uint32_t> code,
                                                    std::span<const std::uint32_t> constants,
                                                    const std::string& name);

/// Of SPIR-V code.
[[nodiscard]] std::size_t instruction_count(std::span<const std::uint32_t> code);

}  // namespace facet::gpu
