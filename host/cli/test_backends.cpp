#include "cli/test_backends.h"

#include "reference/bsdf_evaluator.h"
#include "reference/renderer.h"
#include "render/bsdf_evaluator.h"
#include "render/renderer.h"

namespace facet::cli {

namespace {

class KernelRunner : public TestRunner {
 public:
  KernelRunner(const std::string& device, bool validate, LobeSampling sampling)
      : instance_(validate), device_(instance_, instance_.choose(device)), sampling_(sampling) {}

  statistics::TestBackend backend() override {
    return {[this](const Bsdf& bsdf) -> std::unique_ptr<statistics::BsdfEvaluator> {
              // Scenes need none of these kernels.
              if (!kernels_) kernels_ = std::make_unique<BsdfKernels>(device_);
              return std::make_unique<KernelBsdfEvaluator>(*kernels_, bsdf, sampling_);
            },
            [this](const Scene& scene, RenderSettings settings) -> statistics::SampleRenderer {
              settings.sampling = sampling_;
              const auto renderer = std::make_shared<Renderer>(device_, pack_scene(scene),
                                                               find_features(scene, settings), settings);
              return [this, renderer](std::uint32_t sample) {
                std::vector<vec3> radiances = renderer->render_sample(sample);
                if (renderer->statistics().bound_hits > 0) bound_hit_ = true;
                return radiances;
              };
            }};
  }

  std::string name() const override { return device_.info().name; }

  std::vector<std::string> faults() const override {
    std::vector<std::string> list;
    for (const std::string& message : instance_.validation().messages)
      list.push_back("validation: " + message);
    if (bound_hit_) list.emplace_back("rays were stopped by the safety bound of traversal");
    return list;
  }

 private:
  gpu::Instance instance_;
  gpu::Device device_;
  LobeSampling sampling_;
  std::unique_ptr<BsdfKernels> kernels_;
  bool bound_hit_ = false;
};

template <typename Real>
class ReferenceRunner : public TestRunner {
 public:
  explicit ReferenceRunner(LobeSampling sampling) : sampling_(sampling) {}

  statistics::TestBackend backend() override {
    return {[this](const Bsdf& bsdf) -> std::unique_ptr<statistics::BsdfEvaluator> {
              return std::make_unique<reference::ReferenceBsdfEvaluator<Real>>(bsdf, sampling_);
            },
            [this](const Scene& scene, RenderSettings settings) {
              settings.sampling = sampling_;
              return reference::sample_renderer<Real>(scene, settings);
            }};
  }

  std::string name() const override {
    return sizeof(Real) == sizeof(double) ? "CPU reference in double" : "CPU reference in float";
  }

 private:
  LobeSampling sampling_;
};

}  // namespace

std::unique_ptr<TestRunner> make_kernel_runner(const std::string& device, bool validate,
                                               LobeSampling sampling) {
  return std::make_unique<KernelRunner>(device, validate, sampling);
}

std::unique_ptr<TestRunner> make_reference_runner(const std::string& precision, LobeSampling sampling) {
  if (precision == "double") return std::make_unique<ReferenceRunner<double>>(sampling);
  return std::make_unique<ReferenceRunner<float>>(sampling);
}

}  // namespace facet::cli
