#include "cli/test_backends.h"

#if __has_include("reference/bsdf_evaluator.h")
#include "reference/bsdf_evaluator.h"
#endif
#include "reference/renderer.h"
#include "render/bsdf_evaluator.h"
#include "render/renderer.h"

namespace facet::cli {

namespace {

class KernelRunner : public TestRunner {
 public:
  KernelRunner(const std::string& device, bool validate)
      : instance_(validate), device_(instance_, instance_.choose(device)) {}

  statistics::TestBackend backend() override {
    return {[this](const Bsdf& bsdf) -> std::unique_ptr<statistics::BsdfEvaluator> {
              // Scenes need none of these kernels.
              if (!kernels_) kernels_ = std::make_unique<BsdfKernels>(device_);
              return std::make_unique<KernelBsdfEvaluator>(*kernels_, bsdf, LobeSampling::visible);
            },
            [this](const Scene& scene, const RenderSettings& settings) -> statistics::SampleRenderer {
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
  std::unique_ptr<BsdfKernels> kernels_;
  bool bound_hit_ = false;
};

template <typename Real>
class ReferenceRunner : public TestRunner {
 public:
  statistics::TestBackend backend() override {
    return {[](const Bsdf& bsdf) -> std::unique_ptr<statistics::BsdfEvaluator> {
#if __has_include("reference/bsdf_evaluator.h")
              return std::make_unique<reference::ReferenceBsdfEvaluator<Real>>(bsdf, LobeSampling::visible);
#else
              (void)bsdf;
              throw InputError("no BSDF evaluation in the reference yet");
#endif
            },
            [](const Scene& scene, const RenderSettings& settings) {
              return reference::sample_renderer<Real>(scene, settings);
            }};
  }

  std::string name() const override {
    return sizeof(Real) == sizeof(double) ? "CPU reference in double" : "CPU reference in float";
  }
};

}  // namespace

std::unique_ptr<TestRunner> make_kernel_runner(const std::string& device, bool validate) {
  return std::make_unique<KernelRunner>(device, validate);
}

std::unique_ptr<TestRunner> make_reference_runner(const std::string& precision) {
  if (precision == "double") return std::make_unique<ReferenceRunner<double>>();
  return std::make_unique<ReferenceRunner<float>>();
}

}  // namespace facet::cli
