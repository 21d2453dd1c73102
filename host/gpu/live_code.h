#pragma once
// Which code of a kernel runs under given specialization constants.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gpu/spirv_module.h"

namespace facet::gpu {

/// No instruction, no block.
inline constexpr std::uint32_t no_id = ~0U;

/// What specialization constants make of a module. Tables by id; blocks go by their labels' ids.
struct LiveCode {
  std::vector<spirv::Instruction> instructions;  ///< of the module, all
  std::vector<std::size_t> definition;           ///< index of an id's instruction
  std::vector<spirv::Constant> value;            ///< of an id, where it is known
  std::size_t first_function = 0;                ///< index
  std::vector<std::size_t> functions;            ///< those called: indices where they begin
  std::vector<bool> is_live_block;
  std::vector<std::uint32_t> taken;        ///< the one way on of a block whose branch is decided
  std::vector<std::uint32_t> continue_of;  ///< of a loop's head: its continue target
  std::vector<std::uint32_t> head_of;      ///< of a continue target: its loop's head

  /// Whether the block at the end of which a way begins goes that way.
  [[nodiscard]] bool comes(std::uint32_t parent, std::uint32_t block) const {
    return is_live_block[parent] && (taken[parent] == no_id || taken[parent] == block);
  }
};

/// Follows constants through a kernel's values, branches and calls, not through variables. The code
/// has to outlive the result. Throws DeviceError where it is none or of an unexpected form; `name`
/// is for that message.
[[nodiscard]] LiveCode find_live_code(std::span<const std::uint32_t> code,
                                      std::span<const std::uint32_t> constants,
                                      const std::string& name);

}  // namespace facet::gpu
