#pragma once
// The kernels against the reference in tests.
#include "parity/parity.h"
#include "support/render.h"

namespace facet::test {

/// Renders with the kernels and compares with the reference; expects that no validation message was
/// heard.
[[nodiscard]] parity::ParityReport compare_with_reference(const Scene& scene,
                                                          const RenderSettings& settings);

/// Expects parity, and says what does not hold.
void expect_parity(const Scene& scene, const RenderSettings& settings);

/// Whether some half vector is sampled, so that it matters how.
[[nodiscard]] bool samples_half_vectors(const Scene& scene);

/// Shipped scenes: "cbox/cbox_mis.xml", ..., sorted.
[[nodiscard]] std::vector<std::string> shipped_scenes();

/// The name of a test with a text parameter, of characters that gtest accepts.
[[nodiscard]] std::string test_name(const ::testing::TestParamInfo<std::string>& info);

}  // namespace facet::test
