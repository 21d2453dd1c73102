#include "gpu/live_code.h"

#include <algorithm>

#include "core/error.h"

namespace facet::gpu {

namespace {

using spirv::Constant;
using spirv::Instruction;

class Finder {
 public:
  Finder(std::span<const std::uint32_t> code, std::span<const std::uint32_t> constants,
         const std::string& name)
      : constants_(constants), name_(name) {
    live_.instructions = spirv::parse(code);
    if (live_.instructions.empty()) fail("it is no SPIR-V");
    const std::uint32_t bound = code[spirv::bound_word];
    live_.definition.resize(bound, no_id);
    live_.value.resize(bound);
    live_.taken.resize(bound, no_id);
    live_.continue_of.resize(bound, no_id);
    live_.head_of.resize(bound, no_id);
    live_.is_live_block.resize(bound);
    spec_id_.resize(bound, no_id);
    is_called_.resize(bound);
    for (std::size_t k = 0; k < live_.instructions.size(); ++k) {
      if (const std::uint32_t id = live_.instructions[k].result(); id != 0)
        live_.definition[id] = k;
    }
  }

  LiveCode find() {
    evaluate_constants();
    follow_functions();
    return std::move(live_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw DeviceError("the kernel " + name_ + " cannot be specialised: " + why);
  }

  /// Up to the first function.
  void evaluate_constants() {
    for (const Instruction& i : live_.instructions) {
      const auto operands = i.operands();
      if (i.opcode() == spv::OpFunction) return;
      ++live_.first_function;
      if (i.opcode() == spv::OpDecorate && operands[1] == spv::DecorationSpecId)
        spec_id_[operands[0]] = operands[2];
      if (i.result() != 0) live_.value[i.result()] = value_of_constant(i);
    }
  }

  /// None of other instructions, and of constants that are not 32 bits.
  [[nodiscard]] Constant value_of_constant(const Instruction& i) const {
    const auto operands = i.operands();
    switch (i.opcode()) {
      case spv::OpConstantFalse:
        return 0;
      case spv::OpConstantTrue:
        return 1;
      case spv::OpConstant:
        return operands.size() == 1 ? Constant(operands[0]) : Constant();
      case spv::OpSpecConstantFalse:
        return given(i).value_or(0) == 0 ? 0 : 1;
      case spv::OpSpecConstantTrue:
        return given(i).value_or(1) == 0 ? 0 : 1;
      case spv::OpSpecConstant:
        return given(i).value_or(operands[0]);
      case spv::OpSpecConstantOp:
        if (const Constant value = value_of(static_cast<spv::Op>(operands[0]), operands.subspan(1)))
          return value;
        fail("it has a constant expression of an unexpected kind");
      case spv::OpSpecConstantComposite:
        fail("it has a composite specialization constant");
      default:
        return {};
    }
  }

  [[nodiscard]] Constant value_of(spv::Op opcode, std::span<const std::uint32_t> operands) const {
    const auto value = [&](std::size_t k) {
      // Some operations have literal numbers among their operands.
      return k < operands.size() && operands[k] < live_.value.size() ? live_.value[operands[k]]
                                                                     : Constant();
    };
    return spirv::evaluate(opcode, value(0), value(1));
  }

  [[nodiscard]] Constant given(const Instruction& i) const {
    const std::uint32_t id = spec_id_[i.result()];
    return id < constants_.size() ? Constant(constants_[id]) : Constant();
  }

  /// Follows calls from the entry points on.
  void follow_functions() {
    for (std::size_t k = 0; k < live_.first_function; ++k) {
      if (live_.instructions[k].opcode() == spv::OpEntryPoint) call(live_.instructions[k].words[2]);
    }
    // By index, since follow_function appends.
    for (std::size_t k = 0; k < live_.functions.size(); ++k)  // NOLINT(modernize-loop-convert)
      follow_function(live_.functions[k]);
    std::sort(live_.functions.begin(), live_.functions.end());
  }

  void call(std::uint32_t function) {
    if (is_called_[function]) return;
    is_called_[function] = true;
    live_.functions.push_back(live_.definition[function]);
  }

  /// Finds the live blocks. Blocks stand behind those that lead to them, but for the heads of
  /// loops.
  void follow_function(std::size_t begin) {
    std::uint32_t block = 0;
    for (std::size_t k = begin; live_.instructions[k].opcode() != spv::OpFunctionEnd; ++k) {
      const Instruction& i = live_.instructions[k];
      if (i.opcode() == spv::OpLabel) {
        if (block == 0) live_.is_live_block[i.result()] = true;
        block = i.result();
      }
      if (block == 0 || !live_.is_live_block[block]) continue;
      follow(i, k, block);
    }
  }

  void follow(const Instruction& i, std::size_t at, std::uint32_t block) {
    const auto operands = i.operands();
    switch (i.opcode()) {
      case spv::OpFunctionCall:
        call(operands[0]);
        return;
      case spv::OpPhi:
        live_.value[i.result()] = value_of_phi(i, at, block);
        return;
      case spv::OpSelectionMerge:
        return;
      // Live are those of its blocks that branches lead to.
      case spv::OpLoopMerge:
        live_.continue_of[block] = operands[1];
        live_.head_of[operands[1]] = block;
        return;
      case spv::OpBranchConditional:
        // Not those of loops, which want their form.
        if (const Constant condition = live_.value[operands[0]];
            condition && live_.instructions[at - 1].opcode() == spv::OpSelectionMerge) {
          live_.taken[block] = *condition != 0 ? operands[1] : operands[2];
          lead_to(live_.taken[block], at);
          return;
        }
        break;
      default:
        break;
    }
    for (const std::uint32_t label : spirv::labels_of(i)) lead_to(label, at);
    if (i.result() != 0) live_.value[i.result()] = value_of(i.opcode(), operands);
  }

  void lead_to(std::uint32_t label, std::size_t at) {
    if (live_.definition[label] < at && !live_.is_live_block[label])
      fail("its blocks are in an unexpected order");
    live_.is_live_block[label] = true;
  }

  /// Where all ways that lead to its block bring the same.
  [[nodiscard]] Constant value_of_phi(const Instruction& phi, std::size_t at,
                                      std::uint32_t block) const {
    Constant common;
    const auto operands = phi.operands();
    for (std::size_t k = 0; k < operands.size(); k += 2) {
      const std::uint32_t parent = operands[k + 1];
      // The way back of a loop is not known yet.
      if (live_.definition[parent] > at) return {};
      if (!live_.comes(parent, block)) continue;
      const Constant value = live_.value[operands[k]];
      if (!value || (common && *common != *value)) return {};
      common = value;
    }
    return common;
  }

  std::span<const std::uint32_t> constants_;
  const std::string& name_;
  LiveCode live_;
  std::vector<std::uint32_t> spec_id_;  ///< of a specialization constant's id
  std::vector<bool> is_called_;         ///< functions, by id
};

}  // namespace

LiveCode find_live_code(std::span<const std::uint32_t> code,
                        std::span<const std::uint32_t> constants, const std::string& name) {
  return Finder(code, constants, name).find();
}

}  // namespace facet::gpu
