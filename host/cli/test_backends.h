#pragma once
// Who evaluates the BSDFs and renders the scenes of `facet test`.
#include <memory>
#include <string>

#include "statistics/nori_tests.h"

namespace facet::cli {

/// A backend, with what it needs to live.
class TestRunner {
 public:
  TestRunner() = default;
  virtual ~TestRunner() = default;
  TestRunner(const TestRunner&) = delete;
  TestRunner& operator=(const TestRunner&) = delete;

  [[nodiscard]] virtual statistics::TestBackend backend() = 0;
  /// For people.
  [[nodiscard]] virtual std::string name() const = 0;
  /// Faults beside the cases' own: validation messages, bounds that were hit; one line each.
  [[nodiscard]] virtual std::vector<std::string> faults() const { return {}; }
};

/// The kernels on a Vulkan device (by index or part of its name; empty: the best).
[[nodiscard]] std::unique_ptr<TestRunner> make_kernel_runner(const std::string& device, bool validate,
                                                             LobeSampling sampling);

/// The reference in "float" or "double".
[[nodiscard]] std::unique_ptr<TestRunner> make_reference_runner(const std::string& precision,
                                                                LobeSampling sampling);

}  // namespace facet::cli
