#pragma once
// The kernels on a Vulkan device.
#include <optional>

#include "gpu/device.h"
#include "render/kernel_bsdf_evaluator.h"
#include "render/kernel_store.h"
#include "scene/testable_backend.h"

namespace facet {

class KernelBackend : public TestableBackend {
 public:
  /// device: an index or part of a name; empty: the best. Throws DeviceError where there is none.
  KernelBackend(const std::string& device, bool validate) : device_(device, validate) {}

  [[nodiscard]] std::string name() const override { return device_.info().name; }
  [[nodiscard]] std::string driver() const override { return device_.info().driver; }
  [[nodiscard]] std::vector<std::string> validation_messages() const override {
    return device_.validation_messages();
  }

  using TestableBackend::start;
  [[nodiscard]] std::unique_ptr<Rendering> start(const ScenePtr& scene,
                                                 const RenderSettings& settings) override;
  [[nodiscard]] std::unique_ptr<statistics::BsdfEvaluator> evaluator(
      const Bsdf& bsdf, LobeSampling sampling) override;

  [[nodiscard]] gpu::Device& device() { return device_; }
  /// Of all renders so far.
  [[nodiscard]] KernelStore& kernels() { return kernels_; }

 private:
  gpu::Device device_;
  KernelStore kernels_;
  std::optional<BsdfKernels> bsdf_kernels_;  ///< scenes need none of these
};

}  // namespace facet
