#include "gpu/specialise.h"

#include <spirv-tools/optimizer.hpp>
#include <unordered_map>

#include "core/error.h"

namespace facet::gpu {

std::vector<std::uint32_t> specialise(std::span<const std::uint32_t> code,
                                      std::span<const std::uint32_t> constants, const std::string& name) {
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
  for (std::uint32_t id = 0; id < constants.size(); ++id) values[id] = {constants[id]};
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
  optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
      // First what is quick and leaves less for the others.
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
      .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
      .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
      .RegisterPass(spvtools::CreateCCPPass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
      .RegisterPass(spvtools::CreateAggressiveDCEPass());
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);
  std::vector<std::uint32_t> result;
  if (!optimizer.Run(code.data(), code.size(), &result, options))
    throw DeviceError("the kernel " + name + " cannot be specialised");
  return result;
}

std::size_t instruction_count(std::span<const std::uint32_t> code) {
  constexpr std::size_t header_words = 5;
  std::size_t count = 0;
  // An instruction's first word has its length in the upper half.
  for (std::size_t at = header_words; at < code.size(); at += code[at] >> 16U) ++count;
  return count;
}

}  // namespace facet::gpu
