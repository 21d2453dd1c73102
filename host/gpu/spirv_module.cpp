#include "gpu/spirv_module.h"

namespace facet::gpu::spirv {

namespace {

struct Results {
  bool type = false;
  bool id = false;
};

Results results_of(spv::Op opcode) {
  Results r;
  spv::HasResultAndType(opcode, &r.id, &r.type);
  return r;
}

}  // namespace

std::uint32_t Instruction::result() const {
  const Results r = results_of(opcode());
  return r.id ? words[r.type ? 2 : 1] : 0;
}

std::span<const std::uint32_t> Instruction::operands() const {
  const Results r = results_of(opcode());
  return words.subspan(1U + (r.type ? 1 : 0) + (r.id ? 1 : 0));
}

std::vector<Instruction> parse(std::span<const std::uint32_t> code) {
  std::vector<Instruction> instructions;
  if (code.size() < header_words || code[0] != spv::MagicNumber) return {};
  for (std::size_t at = header_words; at < code.size();) {
    const std::size_t length = code[at] >> spv::WordCountShift;
    if (length == 0 || length > code.size() - at) return {};
    instructions.push_back({code.subspan(at, length)});
    at += length;
  }
  return instructions;
}

bool has_effect(const Instruction& i) {
  switch (i.opcode()) {
    case spv::OpFunction:
    case spv::OpFunctionParameter:
    case spv::OpFunctionCall:
    case spv::OpLabel:
      return true;
    default:
      break;
  }
  return i.result() == 0 || (i.opcode() >= spv::OpAtomicLoad && i.opcode() <= spv::OpAtomicXor);
}

std::vector<std::uint32_t> labels_of(const Instruction& i) {
  const auto operands = i.operands();
  switch (i.opcode()) {
    case spv::OpSelectionMerge:
    case spv::OpBranch:
      return {operands[0]};
    case spv::OpLoopMerge:
      return {operands[0], operands[1]};
    case spv::OpBranchConditional:
      return {operands[1], operands[2]};
    case spv::OpSwitch: {
      std::vector<std::uint32_t> labels{operands[1]};
      for (std::size_t k = 3; k < operands.size(); k += 2) labels.push_back(operands[k]);
      return labels;
    }
    default:
      return {};
  }
}

bool is_remark(const Instruction& i) {
  const spv::Op opcode = i.opcode();
  return opcode == spv::OpName || opcode == spv::OpMemberName || opcode == spv::OpDecorate ||
         opcode == spv::OpMemberDecorate;
}

Constant evaluate(spv::Op opcode, Constant a, Constant b) {
  // One operand may be enough.
  if (opcode == spv::OpLogicalAnd && (a == 0U || b == 0U)) return 0U;
  if (opcode == spv::OpLogicalOr && (a == 1U || b == 1U)) return 1U;
  if (!a) return {};
  if (opcode == spv::OpLogicalNot) return *a == 0 ? 1U : 0U;
  if (!b) return {};
  switch (opcode) {
    case spv::OpLogicalAnd:
    case spv::OpBitwiseAnd:
      return *a & *b;
    case spv::OpLogicalOr:
    case spv::OpBitwiseOr:
      return *a | *b;
    case spv::OpIEqual:
    case spv::OpLogicalEqual:
      return *a == *b ? 1U : 0U;
    case spv::OpINotEqual:
    case spv::OpLogicalNotEqual:
      return *a != *b ? 1U : 0U;
    case spv::OpUGreaterThan:
      return *a > *b ? 1U : 0U;
    case spv::OpUGreaterThanEqual:
      return *a >= *b ? 1U : 0U;
    case spv::OpULessThan:
      return *a < *b ? 1U : 0U;
    case spv::OpULessThanEqual:
      return *a <= *b ? 1U : 0U;
    default:
      return {};
  }
}

std::vector<Instruction> without_unused(std::span<const Instruction> instructions,
                                        std::uint32_t bound) {
  constexpr std::size_t none = ~std::size_t{0};
  std::vector<std::size_t> definition(bound, none);
  for (std::size_t k = 0; k < instructions.size(); ++k) {
    if (const std::uint32_t id = instructions[k].result(); id != 0) definition[id] = k;
  }
  std::vector<bool> is_used(bound);
  std::vector<std::size_t> pending;
  for (std::size_t k = 0; k < instructions.size(); ++k) {
    if (!is_remark(instructions[k]) && has_effect(instructions[k])) pending.push_back(k);
  }
  while (!pending.empty()) {
    const Instruction& user = instructions[pending.back()];
    pending.pop_back();
    for (const std::uint32_t id : user.words.subspan(1)) {
      if (id >= bound || is_used[id] || definition[id] == none) continue;
      is_used[id] = true;
      pending.push_back(definition[id]);
    }
  }
  std::vector<Instruction> used;
  for (const Instruction& i : instructions) {
    if (is_remark(i) ? is_used[i.operands()[0]] : has_effect(i) || is_used[i.result()])
      used.push_back(i);
  }
  return used;
}

std::vector<std::uint32_t> assemble(std::span<const std::uint32_t> header,
                                    std::span<const Instruction> instructions) {
  std::vector<std::uint32_t> code(header.begin(), header.end());
  for (const Instruction& i : instructions) code.insert(code.end(), i.words.begin(), i.words.end());
  return code;
}

}  // namespace facet::gpu::spirv
