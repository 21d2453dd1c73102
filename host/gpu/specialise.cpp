#include "gpu/specialise.h"

#include <deque>

#include "gpu/live_code.h"

namespace facet::gpu {

namespace {

using spirv::Constant;
using spirv::Instruction;

/// Writes the live part of a module.
class Specialisation {
 public:
  Specialisation(std::span<const std::uint32_t> code, const LiveCode& live)
      : code_(code), live_(live), is_target_(code[spirv::bound_word]) {}

  std::vector<std::uint32_t> run() {
    keep_declarations();
    for (const std::size_t begin : live_.functions) keep_function(begin);
    return spirv::assemble(code_.first(spirv::header_words),
                           spirv::without_unused(kept_, code_[spirv::bound_word]));
  }

 private:
  /// An instruction of other words than the module's.
  Instruction make(std::initializer_list<std::uint32_t> operands, spv::Op opcode) {
    std::vector<std::uint32_t>& words =
        made_.emplace_back(1, spirv::first_word(opcode, operands.size() + 1));
    words.insert(words.end(), operands);
    return {words};
  }

  Instruction make_constant(std::uint32_t type, std::uint32_t id, std::uint32_t value) {
    if (live_.instructions[live_.definition[type]].opcode() != spv::OpTypeBool)
      return make({type, id, value}, spv::OpConstant);
    return make({type, id}, value == 0 ? spv::OpConstantFalse : spv::OpConstantTrue);
  }

  /// Up to the first function, all but debug information; constants have their values.
  void keep_declarations() {
    for (const Instruction& i : std::span(live_.instructions).first(live_.first_function)) {
      const bool names = i.opcode() == spv::OpName || i.opcode() == spv::OpMemberName;
      const bool specializes =
          i.opcode() == spv::OpDecorate && i.operands()[1] == spv::DecorationSpecId;
      if (names || specializes) continue;
      const Constant value = i.result() == 0 ? Constant() : live_.value[i.result()];
      kept_.push_back(value ? make_constant(i.words[1], i.result(), *value) : i);
    }
  }

  /// A function's live blocks, with one way on where the other is never taken. A dead block that a
  /// live one names, as that where its ways meet, stays as a label.
  void keep_function(std::size_t begin) {
    name_targets(begin);
    std::uint32_t block = 0;
    for (std::size_t k = begin;; ++k) {
      const Instruction& i = live_.instructions[k];
      if (i.opcode() == spv::OpFunctionEnd) {
        kept_.push_back(i);
        return;
      }
      if (i.opcode() == spv::OpLabel) block = i.result();
      if (block == 0 || live_.is_live_block[block]) {
        keep(i, block);
      } else if (i.opcode() == spv::OpLabel && is_target_[block]) {
        kept_.push_back(i);
        // Every loop has a way back, even where nothing gets there.
        const std::uint32_t head = live_.head_of[block];
        kept_.push_back(head == no_id ? make({}, spv::OpUnreachable) : make({head}, spv::OpBranch));
      }
    }
  }

  void keep(const Instruction& i, std::uint32_t block) {
    const bool decided = live_.taken[block] != no_id;
    if (i.opcode() == spv::OpPhi) {
      kept_.push_back(without_dead_ways(i, block));
    } else if (decided && i.opcode() == spv::OpBranchConditional) {
      kept_.push_back(make({live_.taken[block]}, spv::OpBranch));
    } else if (!decided || i.opcode() != spv::OpSelectionMerge) {
      kept_.push_back(i);
    }
  }

  void name_targets(std::size_t begin) {
    std::uint32_t block = 0;
    for (std::size_t k = begin; live_.instructions[k].opcode() != spv::OpFunctionEnd; ++k) {
      const Instruction& i = live_.instructions[k];
      if (i.opcode() == spv::OpLabel) block = i.result();
      if (!live_.is_live_block[block] || live_.taken[block] != no_id) continue;
      for (const std::uint32_t label : spirv::labels_of(i)) is_target_[label] = true;
    }
  }

  Instruction without_dead_ways(const Instruction& phi, std::uint32_t block) {
    std::vector<std::uint32_t>& words =
        made_.emplace_back(phi.words.begin(), phi.words.begin() + 3);
    const auto operands = phi.operands();
    for (std::size_t k = 0; k < operands.size(); k += 2) {
      if (live_.comes(operands[k + 1], block))
        words.insert(words.end(), {operands[k], operands[k + 1]});
    }
    // A loop's way back that nothing takes brings what there was.
    if (const std::uint32_t way_back = live_.continue_of[block];
        way_back != no_id && !live_.is_live_block[way_back])
      words.insert(words.end(), {phi.result(), way_back});
    words[0] = spirv::first_word(spv::OpPhi, words.size());
    return {words};
  }

  std::span<const std::uint32_t> code_;
  const LiveCode& live_;
  std::deque<std::vector<std::uint32_t>>
      made_;                     ///< words of instructions that differ from the module's
  std::vector<bool> is_target_;  ///< labels that live blocks name
  std::vector<Instruction> kept_;
};

}  // namespace

std::vector<std::uint32_t> specialise(std::span<const std::uint32_t> code,
                                      std::span<const std::uint32_t> constants,
                                      const std::string& name) {
  return Specialisation(code, find_live_code(code, constants, name)).run();
}

std::size_t instruction_count(std::span<const std::uint32_t> code) {
  return spirv::parse(code).size();
}

}  // namespace facet::gpu
