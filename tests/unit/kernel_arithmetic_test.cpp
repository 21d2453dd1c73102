// The compiled kernels compute the same bits everywhere: no driver may reassociate or fuse a float
// operation, no built-in function is of a precision that drivers choose, and the compiler has
// folded no expression of float constants, which it would do in double.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "gpu/specialise.h"
#include "render/features.h"
#include "support/spirv.h"

namespace facet::test {
namespace {

using Operands = std::span<const std::uint32_t>;

constexpr std::uint32_t op_ext_inst = 12;
constexpr std::uint32_t op_type_float = 22;
constexpr std::uint32_t op_type_vector = 23;
constexpr std::uint32_t op_type_matrix = 24;
constexpr std::uint32_t op_constant = 43;
constexpr std::uint32_t op_function = 54;
constexpr std::uint32_t op_function_call = 57;
constexpr std::uint32_t op_decorate = 71;
constexpr std::uint32_t decoration_no_contraction = 42;

/// Two scenes' worth: with everything in, and with little.
std::array<std::array<std::uint32_t, shared::SPEC_COUNT>, 2> example_constants() {
  Features little;
  little.bsdf_mask = 1;
  little.emitter_mask = 1;
  auto everything = little.with_everything().constants(shared::LARGEST_STACK_SIZE);
  for (const std::uint32_t flag :
       {shared::SPEC_EMITTER_SAMPLING, shared::SPEC_MATERIAL_SAMPLING, shared::SPEC_VISIBLE_NORMALS,
        shared::SPEC_POWER_HEURISTIC, shared::SPEC_ROULETTE, shared::SPEC_VARIANCE,
        shared::SPEC_SAMPLER, shared::SPEC_CAMERA_BOUNCE, shared::SPEC_LIGHT_TREE}) {
    everything[flag] = 1;
  }
  everything[shared::SPEC_INTEGRATOR] = 3;
  return {little.constants(4), everything};
}

/// Calls body(name, words) for every kernel as it is embedded, and as drivers get it.
template <typename Body>
void for_each_form(const Body& body) {
  for_each_kernel([&](const std::string& kernel, Operands words) {
    body(kernel, words);
    for (const auto& constants : example_constants())
      body(kernel + " specialised", gpu::specialise(words, constants, kernel));
  });
}

/// Every arithmetic instruction, from OpSNegate to OpSMulExtended.
bool is_arithmetic(std::uint32_t opcode) { return opcode >= 126 && opcode <= 152; }

TEST(KernelArithmetic, every_float_operation_is_decorated) {
  std::size_t most = 0;
  for_each_form([&](const std::string& kernel, Operands words) {
    std::set<std::uint32_t> float_types;
    std::set<std::uint32_t> decorated;
    std::set<std::uint32_t> operations;
    for_each_instruction(words, [&](std::uint32_t opcode, Operands o) {
      const bool composite = opcode == op_type_vector || opcode == op_type_matrix;
      if (opcode == op_type_float || (composite && float_types.contains(o[1])))
        float_types.insert(o[0]);
      if (opcode == op_decorate && o[1] == decoration_no_contraction) decorated.insert(o[0]);
      if (is_arithmetic(opcode) && float_types.contains(o[0])) operations.insert(o[1]);
    });
    EXPECT_EQ(decorated, operations) << kernel;
    most = std::max(most, operations.size());
  });
  EXPECT_GT(most, 400U) << "the shading kernel has many";
}

TEST(KernelArithmetic, kernels_use_no_builtin_transcendental_function) {
  // Of GLSL.std.450: what is exact. FAbs, SAbs, Floor, Sqrt, FMin, UMin, SMin, FMax, UMax, SMax,
  // SClamp, UClamp, FindUMsb
  const std::set<std::uint32_t> exact{4, 5, 8, 31, 37, 38, 39, 40, 41, 42, 44, 45, 75};
  for_each_form([&](const std::string& kernel, Operands words) {
    for_each_instruction(words, [&](std::uint32_t opcode, Operands o) {
      if (opcode != op_ext_inst) return;
      EXPECT_TRUE(exact.contains(o[3])) << kernel << ": GLSL.std.450 " << o[3];
    });
  });
}

/// Magnitudes of the numbers that stand in the shaders' source.
std::set<float> literals() {
  std::set<float> values;
  const std::regex number(R"((\.[0-9]+|\b[0-9]+\.?[0-9]*)([eE][-+]?[0-9]+)?)");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(FACET_SHADERS)) {
    if (!entry.is_regular_file()) continue;
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const std::string source = text.str();
    for (std::sregex_iterator i(source.begin(), source.end(), number), end; i != end; ++i)
      values.insert(std::strtof(i->str().c_str(), nullptr));
  }
  return values;
}

TEST(KernelArithmetic, what_a_scene_lacks_is_gone_from_its_kernels) {
  // OpSpecConstantTrue to OpSpecConstantOp
  const auto is_specialization = [](std::uint32_t opcode) { return opcode >= 48 && opcode <= 52; };
  const auto count = [&](Operands words) {
    std::size_t instructions = 0;
    for_each_instruction(words, [&](std::uint32_t opcode, Operands /*o*/) {
      ++instructions;
      EXPECT_FALSE(is_specialization(opcode));
    });
    return instructions;
  };
  const Operands bounce = kernel_code(Kernel::bounce, GeometryFetch::texel_buffer);
  const auto [little, everything] = example_constants();
  const std::size_t least = count(gpu::specialise(bounce, little, "bounce"));
  const std::size_t most = count(gpu::specialise(bounce, everything, "bounce"));
  std::printf("bounce: %zu instructions with everything in, %zu with little\n", most, least);
  // Two hundredths above what was measured.
  EXPECT_LE(least, 3084U);
  EXPECT_LE(most, 11358U);
}

TEST(KernelArithmetic, few_calls_are_left) {
  std::size_t most = 0;
  for_each_kernel([&](const std::string& kernel, Operands words) {
    std::size_t calls = 0;
    for_each_instruction(words, [&](std::uint32_t opcode, Operands o) {
      if (opcode == op_function_call) ++calls;
      if (opcode == op_function) {
        EXPECT_EQ(o[2], 0U) << kernel << " tells drivers what to inline";
      }
    });
    most = std::max(most, calls);
  });
  std::printf("at most %zu calls in a kernel\n", most);
  // A tenth above what was measured: the build inlines.
  EXPECT_LE(most, 517U);
}

TEST(KernelArithmetic, float_constants_stand_in_the_source) {
  const std::set<float> known = literals();
  EXPECT_GT(known.size(), 60U);
  for_each_form([&](const std::string& kernel, Operands words) {
    std::set<std::uint32_t> float_types;
    for_each_instruction(words, [&](std::uint32_t opcode, Operands o) {
      if (opcode == op_type_float) float_types.insert(o[0]);
      if (opcode != op_constant || !float_types.contains(o[0])) return;
      const float value = std::abs(std::bit_cast<float>(o[2]));
      EXPECT_TRUE(known.contains(value))
          << kernel << ": " << value << " was computed by the compiler";
    });
  });
}

}  // namespace
}  // namespace facet::test
