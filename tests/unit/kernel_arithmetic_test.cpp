// The compiled kernels compute the same bits everywhere: no driver may reassociate or fuse a float operation,
// no built-in function is of a precision that drivers choose, and the compiler has folded no expression of
// float constants, which it would do in double.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "support/spirv.h"

namespace facet::test {
namespace {

using Operands = std::span<const std::uint32_t>;

constexpr std::uint32_t op_ext_inst = 12;
constexpr std::uint32_t op_type_float = 22;
constexpr std::uint32_t op_type_vector = 23;
constexpr std::uint32_t op_type_matrix = 24;
constexpr std::uint32_t op_constant = 43;
constexpr std::uint32_t op_decorate = 71;
constexpr std::uint32_t decoration_no_contraction = 42;

/// Every arithmetic instruction, from OpSNegate to OpSMulExtended.
bool is_arithmetic(std::uint32_t opcode) { return opcode >= 126 && opcode <= 152; }

TEST(KernelArithmetic, every_float_operation_is_decorated) {
  std::size_t most = 0;
  for_each_kernel([&](const std::string& kernel, Operands words) {
    std::set<std::uint32_t> float_types;
    std::set<std::uint32_t> decorated;
    std::set<std::uint32_t> operations;
    for_each_instruction(words, [&](std::uint32_t opcode, Operands o) {
      const bool composite = opcode == op_type_vector || opcode == op_type_matrix;
      if (opcode == op_type_float || (composite && float_types.contains(o[1]))) float_types.insert(o[0]);
      if (opcode == op_decorate && o[1] == decoration_no_contraction) decorated.insert(o[0]);
      if (is_arithmetic(opcode) && float_types.contains(o[0])) operations.insert(o[1]);
    });
    EXPECT_EQ(decorated, operations) << kernel;
    most = std::max(most, operations.size());
  });
  EXPECT_GT(most, 400U) << "the shading kernel has many";
}

TEST(KernelArithmetic, kernels_use_no_builtin_transcendental_function) {
  // Of GLSL.std.450: what is exact. FAbs, SAbs, Floor, Sqrt, FMin, UMin, SMin, FMax, UMax, SMax, SClamp,
  // UClamp
  const std::set<std::uint32_t> exact{4, 5, 8, 31, 37, 38, 39, 40, 41, 42, 44, 45};
  for_each_kernel([&](const std::string& kernel, Operands words) {
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

TEST(KernelArithmetic, float_constants_stand_in_the_source) {
  const std::set<float> known = literals();
  EXPECT_GT(known.size(), 60U);
  for_each_kernel([&](const std::string& kernel, Operands words) {
    std::set<std::uint32_t> float_types;
    for_each_instruction(words, [&](std::uint32_t opcode, Operands o) {
      if (opcode == op_type_float) float_types.insert(o[0]);
      if (opcode != op_constant || !float_types.contains(o[0])) return;
      const float value = std::abs(std::bit_cast<float>(o[2]));
      EXPECT_TRUE(known.contains(value)) << kernel << ": " << value << " was computed by the compiler";
    });
  });
}

}  // namespace
}  // namespace facet::test
