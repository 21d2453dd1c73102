#pragma once
// SPIR-V as a list of instructions.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#define SPV_ENABLE_UTILITY_CODE
#include <spirv/unified1/spirv.hpp>

namespace facet::gpu::spirv {

inline constexpr std::size_t header_words = 5;
/// Of the header: one more than the largest id.
inline constexpr std::size_t bound_word = 3;

/// One instruction of a module that outlives it.
struct Instruction {
  std::span<const std::uint32_t> words;  ///< all of them, that of opcode and length included

  [[nodiscard]] spv::Op opcode() const { return static_cast<spv::Op>(words[0] & spv::OpCodeMask); }
  /// 0 without a result.
  [[nodiscard]] std::uint32_t result() const;
  /// What follows the result.
  [[nodiscard]] std::span<const std::uint32_t> operands() const;
};

/// Whether an instruction has to stay even if nothing uses its result.
[[nodiscard]] bool has_effect(const Instruction& i);

/// Whether it only says something of the id that it names first.
[[nodiscard]] bool is_remark(const Instruction& i);

/// The blocks that it leads to or, of a merge instruction, names.
[[nodiscard]] std::vector<std::uint32_t> labels_of(const Instruction& i);

/// Bits of a 32-bit number, or a boolean, where it is known.
using Constant = std::optional<std::uint32_t>;

/// The value of an operation on integers or booleans; none where it is not known, or the operation
/// not one of those that conditions are made of.
[[nodiscard]] Constant evaluate(spv::Op opcode, Constant a, Constant b);

/// Empty where the code is none.
[[nodiscard]] std::vector<Instruction> parse(std::span<const std::uint32_t> code);

/// Those with an effect and what they use, directly or not, in a module of ids below `bound`. Every
/// operand counts as an id: a literal number that happens to equal one keeps a little too much.
[[nodiscard]] std::vector<Instruction> without_unused(std::span<const Instruction> instructions,
                                                      std::uint32_t bound);

/// The reverse of parse.
[[nodiscard]] std::vector<std::uint32_t> assemble(std::span<const std::uint32_t> header,
                                                  std::span<const Instruction> instructions);

/// The first word of an instruction.
[[nodiscard]] constexpr std::uint32_t first_word(spv::Op opcode, std::size_t length) {
  return (static_cast<std::uint32_t>(length) << spv::WordCountShift) |
         static_cast<std::uint32_t>(opcode);
}

}  // namespace facet::gpu::spirv
