// Kernels are specialised as their constants say, and stay valid SPIR-V whatever those are. That
// they compute the same as they did is tests/unit/invariance_test.cpp's.
#include "gpu/specialise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <spirv-tools/libspirv.hpp>

#include "core/error.h"
#include "gpu/spirv_module.h"
#include "render/features.h"
#include "support/spirv.h"

namespace facet::test {
namespace {

using Code = std::vector<std::uint32_t>;

/// What the validator says against it.
std::string complaints(const Code& code) {
  std::string text;
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                               const char* message) { text += message; });
  return tools.Validate(code) ? "" : "invalid: " + text;
}

/// A kernel: x = (feature && count > 2) ? a a : slow(a), and a loop that ends at once where `once`
/// is set.
Code example() {
  const std::string text = R"(
               OpCapability Shader
               OpMemoryModel Logical GLSL450
               OpEntryPoint GLCompute %main "main"
               OpExecutionMode %main LocalSize 1 1 1
               OpDecorate %feature SpecId 0
               OpDecorate %count SpecId 1
               OpDecorate %once SpecId 2
       %void = OpTypeVoid
       %bool = OpTypeBool
       %uint = OpTypeInt 32 0
      %float = OpTypeFloat 32
    %pointer = OpTypePointer Private %float
          %x = OpVariable %pointer Private
     %effect = OpTypeFunction %void
   %function = OpTypeFunction %float %float
    %feature = OpSpecConstantTrue %bool
      %count = OpSpecConstant %uint 7
       %once = OpSpecConstantFalse %bool
        %two = OpConstant %uint 2
        %big = OpSpecConstantOp %bool UGreaterThan %count %two
       %main = OpFunction %void None %effect
      %start = OpLabel
          %a = OpLoad %float %x
               OpSelectionMerge %known None
               OpBranchConditional %feature %more %known
       %more = OpLabel
      %other = OpLogicalNot %bool %big
      %again = OpLogicalNot %bool %other
               OpBranch %known
      %known = OpLabel
       %both = OpPhi %bool %feature %start %again %more
               OpSelectionMerge %found None
               OpBranchConditional %both %yes %no
        %yes = OpLabel
     %square = OpFMul %float %a %a
               OpBranch %found
         %no = OpLabel
    %computed = OpFunctionCall %float %slow %a
               OpBranch %found
      %found = OpLabel
     %result = OpPhi %float %square %yes %computed %no
               OpBranch %head
       %head = OpLabel
      %value = OpPhi %float %result %found %next %step
     %unused = OpFSub %float %value %a
               OpLoopMerge %done %step None
               OpBranchConditional %once %done %inside
     %inside = OpLabel
               OpSelectionMerge %stay None
               OpBranchConditional %once %leave %stay
      %leave = OpLabel
               OpBranch %done
       %stay = OpLabel
    %negated = OpFNegate %float %value
               OpBranch %step
       %step = OpLabel
       %next = OpFDiv %float %negated %a
               OpBranch %head
       %done = OpLabel
               OpStore %x %value
               OpReturn
               OpFunctionEnd
       %slow = OpFunction %float None %function
  %parameter = OpFunctionParameter %float
       %body = OpLabel
        %sum = OpFAdd %float %parameter %parameter
               OpReturnValue %sum
               OpFunctionEnd
)";
  Code code;
  EXPECT_TRUE(spvtools::SpirvTools(SPV_ENV_VULKAN_1_1).Assemble(text, &code));
  EXPECT_EQ(complaints(code), "");
  return code;
}

std::ptrdiff_t count(const Code& code, spv::Op opcode) {
  const auto instructions = gpu::spirv::parse(code);
  return std::count_if(instructions.begin(), instructions.end(),
                       [&](const auto& i) { return i.opcode() == opcode; });
}

TEST(Specialise, a_decided_condition_leaves_one_way) {
  const Code code = example();
  struct Case {
    Code constants;
    bool square;
  };
  for (const auto& [constants, square] :
       {Case{{1, 3, 0}, true}, Case{{1, 2, 0}, false}, Case{{0, 3, 0}, false}, Case{{}, true}}) {
    const Code result = gpu::specialise(code, constants, "example");
    EXPECT_EQ(complaints(result), "");
    EXPECT_EQ(count(result, spv::OpFMul), square ? 1 : 0);
    // The function that it calls is gone with the call.
    EXPECT_EQ(count(result, spv::OpFunctionCall), square ? 0 : 1);
    EXPECT_EQ(count(result, spv::OpFAdd), square ? 0 : 1);
    EXPECT_EQ(count(result, spv::OpFunction), square ? 1 : 2);
    EXPECT_EQ(count(result, spv::OpSelectionMerge), 0);
    EXPECT_EQ(count(result, spv::OpFSub), 0) << "nothing uses it";
    EXPECT_EQ(count(result, spv::OpSpecConstantOp) + count(result, spv::OpSpecConstant), 0);
    EXPECT_EQ(count(result, spv::OpDecorate), 0);
  }
}

TEST(Specialise, loops_keep_their_form) {
  for (const std::uint32_t once : {0U, 1U}) {
    const Code result = gpu::specialise(example(), Code{1, 3, once}, "example");
    EXPECT_EQ(complaints(result), "");
    EXPECT_EQ(count(result, spv::OpLoopMerge), 1);
    // A way back there is, though nothing takes it and what it did is gone.
    EXPECT_EQ(count(result, spv::OpFNegate), once == 1 ? 0 : 1);
    EXPECT_EQ(count(result, spv::OpFDiv), once == 1 ? 0 : 1);
    std::size_t ways = 0;
    for (const auto& i : gpu::spirv::parse(result))
      if (i.opcode() == spv::OpPhi) ways = i.operands().size() / 2;
    EXPECT_EQ(ways, 2U) << "into the loop's head, whose phi is the last";
    EXPECT_EQ(count(result, spv::OpBranchConditional), 1) << "that of the loop's head alone";
    EXPECT_EQ(count(result, once == 1 ? spv::OpConstantTrue : spv::OpConstantFalse), 1);
  }
}

TEST(Specialise, what_is_no_kernel_is_refused) {
  EXPECT_THROW((void)gpu::specialise(Code{}, Code{}, "nothing"), DeviceError);
  EXPECT_THROW((void)gpu::specialise(Code{1, 2, 3, 4, 5, 6, 7}, Code{}, "numbers"), DeviceError);
  Code cut = example();
  cut.back() += 1U << spv::WordCountShift;
  EXPECT_THROW((void)gpu::specialise(cut, Code{}, "cut"), DeviceError);
}

TEST(Specialise, kernels_are_valid_whatever_their_constants) {
  std::mt19937 random(1);
  std::size_t smallest = ~std::size_t{0};
  std::size_t largest = 0;
  for_each_kernel([&](const std::string& kernel, std::span<const std::uint32_t> words) {
    for (int draw = 0; draw < 36; ++draw) {
      Code constants(shared::SPEC_COUNT);
      // Many bits, few bits, or a small number: masks and flags both.
      for (std::uint32_t& c : constants) {
        const auto bits = static_cast<std::uint32_t>(random());
        c = draw % 3 == 0   ? bits & 3U
            : draw % 3 == 1 ? bits
                            : bits & static_cast<std::uint32_t>(random()) & 63U;
      }
      // The integrator of paths with all there is, but no bounce beyond the last one.
      if (draw == 3) {
        constants.assign(shared::SPEC_COUNT, ~0U);
        constants[shared::SPEC_LAST_BOUNCE] = 0;
      }
      constants[shared::SPEC_STACK_SIZE] = 4 + static_cast<std::uint32_t>(draw) % 12;
      constants[shared::SPEC_INTEGRATOR] = static_cast<std::uint32_t>(draw) % 6;
      const Code result = gpu::specialise(words, constants, kernel);
      EXPECT_EQ(complaints(result), "") << kernel;
      if (!kernel.starts_with("bounce")) continue;
      smallest = std::min(smallest, gpu::instruction_count(result));
      largest = std::max(largest, gpu::instruction_count(result));
    }
  });
  EXPECT_LT(smallest * 2, largest) << "the draws are alike";
}

}  // namespace
}  // namespace facet::test
