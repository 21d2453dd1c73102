#include "render/kernel_backend.h"

#include "core/error.h"
#include "render/renderer.h"

namespace facet {

namespace {

class KernelRendering : public RecordedRendering {
 public:
  KernelRendering(KernelBackend& backend, const Scene& scene, const RenderSettings& settings)
      : RecordedRendering(backend, "vulkan", Precision::float_, scene, settings),
        renderer_(backend.device(), pack_scene(scene, settings), backend.kernels()) {}

  void run(const ProgressCallback& progress) override { note(renderer_.render(progress)); }
  std::vector<Radiance> sample(std::uint32_t index) override {
    return renderer_.render_sample(index);
  }
  Film film() const override {
    Film film = renderer_.film();
    film.record = record();
    return film;
  }
  const RenderStatistics& statistics() const override { return renderer_.statistics(); }
  RenderState state() const override {
    RenderState state = renderer_.state();
    state.film.record = record_so_far(renderer_.plan());
    return state;
  }
  bool is_good_moment() const override { return renderer_.plan().is_good_moment(); }
  void restore(const RenderState& state) override { renderer_.restore(state); }

 private:
  Renderer renderer_;
};

}  // namespace

std::unique_ptr<Rendering> KernelBackend::start(const ScenePtr& scene,
                                                const RenderSettings& settings) {
  if (settings.sampling == LobeSampling::uniform)
    throw InputError("uniform sampling of lobes is the reference's alone");
  return std::make_unique<KernelRendering>(*this, *scene, settings);
}

std::unique_ptr<statistics::BsdfEvaluator> KernelBackend::evaluator(const Bsdf& bsdf,
                                                                    LobeSampling sampling) {
  if (!bsdf_kernels_) bsdf_kernels_.emplace(device_);
  return std::make_unique<KernelBsdfEvaluator>(*bsdf_kernels_, bsdf, sampling);
}

}  // namespace facet
