#pragma once
// Walks over the embedded kernels' SPIR-V.
#include <cstdint>
#include <span>
#include <string>

#include "render/kernels.h"

namespace facet::test {

/// Calls body(name, words) for every kernel, with either geometry fetch.
template <typename Body>
void for_each_kernel(const Body& body) {
  for (int k = 0; k < kernel_count; ++k) {
    const auto kernel = static_cast<Kernel>(k);
    body(std::string(kernel_name(kernel)) + " (texel buffers)",
         kernel_code(kernel, GeometryFetch::texel_buffer));
    body(std::string(kernel_name(kernel)) + " (storage buffers)",
         kernel_code(kernel, GeometryFetch::storage_buffer));
  }
}

/// Calls body(opcode, operands) for every instruction.
template <typename Body>
void for_each_instruction(std::span<const std::uint32_t> words, const Body& body) {
  for (std::size_t i = 5; i < words.size(); i += words[i] >> 16U) {
    body(words[i] & 0xffffU, words.subspan(i + 1, (words[i] >> 16U) - 1));
  }
}

}  // namespace facet::test
