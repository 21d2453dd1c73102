#pragma once
// Running the passes of SPIRV-Tools' optimiser.
#include <cstdint>
#include <cstdio>
#include <spirv-tools/optimizer.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace facet {

/// What the passes that `register_passes(optimizer)` registers make of a module, which they trust
/// to be valid. Throws std::runtime_error with `complaint` where they fail.
template <typename RegisterPasses>
[[nodiscard]] std::vector<std::uint32_t> run_passes(const std::vector<std::uint32_t>& module,
                                                    const std::string& complaint,
                                                    const RegisterPasses& register_passes) {
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
  register_passes(optimizer);
  optimizer.SetMessageConsumer([](spv_message_level_t, const char*, const spv_position_t&,
                                  const char* message) { std::fprintf(stderr, "%s\n", message); });
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);
  std::vector<std::uint32_t> out;
  if (!optimizer.Run(module.data(), module.size(), &out, options))
    throw std::runtime_error(complaint);
  return out;
}

}  // namespace facet
