#pragma once
// Specialization of kernels ahead of the driver.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace facet::gpu {

/// The SPIR-V with its specialization constants (32 bits each, ids from 0) fixed, and without what they leave
/// no use for. Drivers do as much, but first inline and rework all of a kernel: Mesa takes ten times as long.
/// No float operation is changed, since NoContraction forbids it. Throws DeviceError where the code is not
/// valid; `name` is for that message.
[[nodiscard]] std::vector<std::uint32_t> specialise(std::span<const std::uint32_t> code,
                                                    std::span<const std::uint32_t> constants,
                                                    const std::string& name);

/// Of SPIR-V code.
[[nodiscard]] std::size_t instruction_count(std::span<const std::uint32_t> code);

}  // namespace facet::gpu
