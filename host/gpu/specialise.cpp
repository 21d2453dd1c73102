#include "gpu/specialise.h"

#include <algorithm>
#include <deque>

#include "core/error.h"
#include "gpu/spirv_module.h"

namespace facet::gpu {

namespace {

using spirv::Constant;
using spirv::Instruction;

/// One specialization of one module. Ids are indices of its tables.
class Specialisation {
 public:
  Specialisation(std::span<const std::uint32_t> code, std::span<const std::uint32_t> constants,
                 const std::string& name)
      : code_(code), constants_(constants), name_(name), module_(spirv::parse(code)) {
    if (module_.empty()) fail("it is no SPIR-V");
    const std::uint32_t bound = code[spirv::bound_word];
    definition_.resize(bound, none);
    value_.resize(bound);
    spec_id_.resize(bound, none);
    taken_.resize(bound, none);
    continue_of_.resize(bound, none);
    head_of_.resize(bound, none);
    is_live_block_.resize(bound);
    is_target_.resize(bound);
    for (std::size_t k = 0; k < module_.size(); ++k) {
      if (const std::uint32_t id = module_[k].result(); id != 0) definition_[id] = k;
    }
  }

  std::vector<std::uint32_t> run() {
    fix_constants();
    follow_functions();
    drop_dead_blocks();
    return spirv::assemble(code_.first(spirv::header_words),
                           spirv::without_unused(kept_, code_[spirv::bound_word]));
  }

 private:
  static constexpr std::uint32_t none = ~0U;

  [[noreturn]] void fail(const std::string& why) const {
    throw DeviceError("the kernel " + name_ + " cannot be specialised: " + why);
  }

  /// An instruction of other words than the module's.
  Instruction make(std::initializer_list<std::uint32_t> operands, spv::Op opcode) {
    std::vector<std::uint32_t>& words =
        made_.emplace_back(1, spirv::first_word(opcode, operands.size() + 1));
    words.insert(words.end(), operands);
    return {words};
  }

  Instruction make_constant(std::uint32_t type, std::uint32_t id, std::uint32_t value) {
    if (module_[definition_[type]].opcode() != spv::OpTypeBool)
      return make({type, id, value}, spv::OpConstant);
    return make({type, id}, value == 0 ? spv::OpConstantFalse : spv::OpConstantTrue);
  }

  /// Up to the first function: gives the constants their values.
  void fix_constants() {
    for (Instruction& i : module_) {
      const auto operands = i.operands();
      if (i.opcode() == spv::OpFunction) return;
      ++first_function_;
      if (i.opcode() == spv::OpDecorate && operands[1] == spv::DecorationSpecId)
        spec_id_[operands[0]] = operands[2];
      if (const Constant value = value_of_constant(i)) {
        value_[i.result()] = value;
        i = make_constant(i.words[1], i.result(), *value);
      }
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
      return k < operands.size() && operands[k] < value_.size() ? value_[operands[k]] : Constant();
    };
    return spirv::evaluate(opcode, value(0), value(1));
  }

  [[nodiscard]] Constant given(const Instruction& i) const {
    const std::uint32_t id = spec_id_[i.result()];
    return id < constants_.size() ? Constant(constants_[id]) : Constant();
  }

  /// Follows calls from the entry points on.
  void follow_functions() {
    for (std::size_t k = 0; k < first_function_; ++k) {
      if (module_[k].opcode() == spv::OpEntryPoint) call(module_[k].words[2]);
    }
    // By index, since follow_function appends.
    for (std::size_t k = 0; k < functions_.size(); ++k)  // NOLINT(modernize-loop-convert)
      follow_function(functions_[k]);
    std::sort(functions_.begin(), functions_.end());
  }

  void call(std::uint32_t function) {
    if (is_target_[function]) return;
    is_target_[function] = true;
    functions_.push_back(definition_[function]);
  }

  /// Finds the live blocks. Blocks stand behind those that lead to them, but for the heads of
  /// loops.
  void follow_function(std::size_t begin) {
    std::uint32_t block = 0;
    for (std::size_t k = begin; module_[k].opcode() != spv::OpFunctionEnd; ++k) {
      const Instruction& i = module_[k];
      if (i.opcode() == spv::OpLabel) {
        if (block == 0) is_live_block_[i.result()] = true;
        block = i.result();
      }
      if (block == 0 || !is_live_block_[block]) continue;
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
        value_[i.result()] = value_of_phi(i, at, block);
        return;
      case spv::OpSelectionMerge:
        return;
      // Live are those of its blocks that branches lead to.
      case spv::OpLoopMerge:
        continue_of_[block] = operands[1];
        head_of_[operands[1]] = block;
        return;
      case spv::OpBranchConditional:
        // Not those of loops, which want their form.
        if (const Constant condition = value_[operands[0]];
            condition && module_[at - 1].opcode() == spv::OpSelectionMerge) {
          taken_[block] = *condition != 0 ? operands[1] : operands[2];
          lead_to(taken_[block], at);
          return;
        }
        break;
      default:
        break;
    }
    for (const std::uint32_t label : spirv::labels_of(i)) lead_to(label, at);
    if (i.result() != 0) value_[i.result()] = value_of(i.opcode(), operands);
  }

  void lead_to(std::uint32_t label, std::size_t at) {
    if (definition_[label] < at && !is_live_block_[label])
      fail("its blocks are in an unexpected order");
    is_live_block_[label] = true;
  }

  /// Where all ways that lead to its block bring the same.
  [[nodiscard]] Constant value_of_phi(const Instruction& phi, std::size_t at,
                                      std::uint32_t block) const {
    Constant common;
    const auto operands = phi.operands();
    for (std::size_t k = 0; k < operands.size(); k += 2) {
      const std::uint32_t parent = operands[k + 1];
      // The way back of a loop is not known yet.
      if (definition_[parent] > at) return {};
      if (!comes(parent, block)) continue;
      const Constant value = value_[operands[k]];
      if (!value || (common && *common != *value)) return {};
      common = value;
    }
    return common;
  }

  /// Keeps what is not debug information, and of functions the live ones' live blocks, with one way
  /// on where the other is never taken. A dead block that a live one names, as that where its ways
  /// meet, stays as a label.
  void drop_dead_blocks() {
    for (const Instruction& i : std::span(module_).first(first_function_)) {
      const bool names = i.opcode() == spv::OpName || i.opcode() == spv::OpMemberName;
      const bool specializes =
          i.opcode() == spv::OpDecorate && i.operands()[1] == spv::DecorationSpecId;
      if (!names && !specializes) kept_.push_back(i);
    }
    for (const std::size_t begin : functions_) {
      name_targets(begin);
      std::uint32_t block = 0;
      for (std::size_t k = begin;; ++k) {
        const Instruction& i = module_[k];
        if (i.opcode() == spv::OpFunctionEnd) {
          kept_.push_back(i);
          break;
        }
        if (i.opcode() == spv::OpLabel) block = i.result();
        if (block == 0 || is_live_block_[block]) {
          keep(i, block);
        } else if (i.opcode() == spv::OpLabel && is_target_[block]) {
          kept_.push_back(i);
          // Every loop has a way back, even where nothing gets there.
          const std::uint32_t head = head_of_[block];
          kept_.push_back(head == none ? make({}, spv::OpUnreachable)
                                       : make({head}, spv::OpBranch));
        }
      }
    }
  }

  void keep(const Instruction& i, std::uint32_t block) {
    const bool decided = taken_[block] != none;
    if (i.opcode() == spv::OpPhi) {
      kept_.push_back(without_dead_ways(i, block));
    } else if (decided && i.opcode() == spv::OpBranchConditional) {
      kept_.push_back(make({taken_[block]}, spv::OpBranch));
    } else if (!decided || i.opcode() != spv::OpSelectionMerge) {
      kept_.push_back(i);
    }
  }

  void name_targets(std::size_t begin) {
    std::uint32_t block = 0;
    for (std::size_t k = begin; module_[k].opcode() != spv::OpFunctionEnd; ++k) {
      const Instruction& i = module_[k];
      if (i.opcode() == spv::OpLabel) block = i.result();
      if (!is_live_block_[block] || taken_[block] != none) continue;
      for (const std::uint32_t label : spirv::labels_of(i)) is_target_[label] = true;
    }
  }

  Instruction without_dead_ways(const Instruction& phi, std::uint32_t block) {
    std::vector<std::uint32_t>& words =
        made_.emplace_back(phi.words.begin(), phi.words.begin() + 3);
    const auto operands = phi.operands();
    for (std::size_t k = 0; k < operands.size(); k += 2) {
      if (comes(operands[k + 1], block)) words.insert(words.end(), {operands[k], operands[k + 1]});
    }
    // A loop's way back that nothing takes brings what there was.
    if (const std::uint32_t way_back = continue_of_[block];
        way_back != none && !is_live_block_[way_back])
      words.insert(words.end(), {phi.result(), way_back});
    words[0] = spirv::first_word(spv::OpPhi, words.size());
    return {words};
  }

  /// Whether the block at the end of which a way begins goes that way.
  [[nodiscard]] bool comes(std::uint32_t parent, std::uint32_t block) const {
    return is_live_block_[parent] && (taken_[parent] == none || taken_[parent] == block);
  }

  std::span<const std::uint32_t> code_;
  std::span<const std::uint32_t> constants_;
  const std::string& name_;
  std::vector<Instruction> module_;
  std::deque<std::vector<std::uint32_t>>
      made_;                             ///< words of instructions that differ from the module's
  std::vector<std::size_t> definition_;  ///< index of an id's instruction
  std::vector<Constant> value_;          ///< of an id
  std::vector<std::uint32_t> spec_id_;   ///< of a specialization constant's id
  std::size_t first_function_ = 0;
  std::vector<std::size_t> functions_;  ///< those called: where they begin
  std::vector<bool> is_live_block_;     ///< by label
  std::vector<bool> is_target_;         ///< functions called, and labels that live blocks name
  std::vector<std::uint32_t> taken_;    ///< by a block's label: the one way on of a decided branch
  std::vector<std::uint32_t> continue_of_;  ///< by the label of a loop's head
  std::vector<std::uint32_t> head_of_;      ///< by the label of a loop's continue target
  std::vector<Instruction> kept_;
};

}  // namespace

std::vector<std::uint32_t> specialise(std::span<const std::uint32_t> code,
                                      std::span<const std::uint32_t> constants,
                                      const std::string& name) {
  return Specialisation(code, constants, name).run();
}

std::size_t instruction_count(std::span<const std::uint32_t> code) {
  return spirv::parse(code).size();
}

}  // namespace facet::gpu
