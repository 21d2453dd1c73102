#include "inline_functions.h"

#include <map>
#include <stdexcept>

#include "gpu/spirv_module.h"
#include "spirv_passes.h"

namespace facet {

namespace {

using Words = std::vector<std::uint32_t>;

/// Words that the further copies of one function may have together, without the functions that it
/// calls, which have their own share.
constexpr std::size_t most_words_of_copies = 500;

struct Function {
  std::size_t control = 0;  ///< where the word is that says whether to inline it
  std::size_t words = 0;
  std::map<std::uint32_t, std::size_t> calls;  ///< how many of which function
  std::size_t copies = 0;                      ///< of its code, if every call of it is inlined
};

/// The functions of a module, by id.
class Functions {
 public:
  explicit Functions(const Words& module) {
    std::size_t at = gpu::spirv::header_words;
    std::uint32_t current = 0;
    for (const gpu::spirv::Instruction& i : gpu::spirv::parse(module)) {
      if (i.opcode() == spv::OpEntryPoint) entry_ = i.words[2];
      if (i.opcode() == spv::OpFunction) {
        current = i.result();
        functions_[current].control = at + 3;
      }
      if (current != 0) functions_[current].words += i.words.size();
      if (i.opcode() == spv::OpFunctionCall) ++functions_[current].calls[i.operands()[0]];
      if (i.opcode() == spv::OpFunctionEnd) current = 0;
      at += i.words.size();
    }
    if (!functions_.contains(entry_)) throw std::runtime_error("a kernel without entry point");
    put_in_order(entry_);
  }

  /// Removes all marks, which are no advice for drivers.
  void unmark(Words& module) const {
    for (const auto& [id, f] : functions_)
      module[f.control] &= ~static_cast<std::uint32_t>(spv::FunctionControlDontInlineMask);
  }

  /// Marks those that are to stay functions.
  void mark_long_ones(Words& module) {
    functions_[entry_].copies = 1;
    // Every caller comes before those that it calls.
    for (auto id = called_first_.rbegin(); id != called_first_.rend(); ++id) {
      Function& f = functions_[*id];
      if ((f.copies - 1) * f.words > most_words_of_copies) {
        module[f.control] |= spv::FunctionControlDontInlineMask;
        f.copies = 1;
      }
      for (const auto& [called, count] : f.calls) functions_[called].copies += count * f.copies;
    }
  }

 private:
  /// GLSL has no recursion.
  void put_in_order(std::uint32_t id) {
    if (is_in_order_[id]) return;
    is_in_order_[id] = true;
    for (const auto& call : functions_[id].calls) put_in_order(call.first);
    called_first_.push_back(id);
  }

  std::map<std::uint32_t, Function> functions_;
  std::map<std::uint32_t, bool> is_in_order_;
  std::vector<std::uint32_t> called_first_;  ///< each before those that call it
  std::uint32_t entry_ = 0;
};

}  // namespace

std::vector<std::uint32_t> inline_functions(const std::vector<std::uint32_t>& module) {
  Words words = module;
  Functions(words).mark_long_ones(words);
  words = run_passes(words, "functions cannot be inlined", [](spvtools::Optimizer& optimizer) {
    // Only functions that return at their ends are inlined.
    optimizer.RegisterPass(spvtools::CreateMergeReturnPass())
        .RegisterPass(spvtools::CreateInlineExhaustivePass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
  });
  Functions(words).unmark(words);
  return words;
}

}  // namespace facet
