#pragma once
// The kernels' BSDFs in tests of all BSDFs.
#include "render/kernel_bsdf_evaluator.h"
#include "support/bsdf_cases.h"
#include "support/render.h"

namespace facet::test {

/// The case on the device of all of a program's tests.
[[nodiscard]] inline KernelBsdfEvaluator kernels_of(const BsdfCase& c) {
  static BsdfKernels kernels(device());
  return {kernels, c.bsdf, c.sampling};
}

/// Which case, for messages.
[[nodiscard]] inline std::string describe(const BsdfCase& c, const vec3& wo) {
  return fmt::format("{}, wo ({}, {}, {})", c.name, wo.x, wo.y, wo.z);
}

/// A test for every BSDF of the shared list; its parameter is the id.
class BsdfTest : public testing::TestWithParam<std::size_t> {
 protected:
  void TearDown() override { expect_silent_validation(); }
};

/// The BSDF's name as the test's.
[[nodiscard]] inline std::string name_of(const testing::TestParamInfo<std::size_t>& info) {
  return std::string(bsdf_type_names[info.param]);
}

}  // namespace facet::test
