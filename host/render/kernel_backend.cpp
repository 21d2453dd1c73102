#include "render/kernel_backend.h"

#include "core/error.h"
#include "render/renderer.h"

namespace facet {

namespace {

class KernelRendering : public Rendering {
 public:
  KernelRendering(gpu::Device& device, const std::string& driver, const Scene& scene,
                  const RenderSettings& settings)
      : renderer_(device, pack_scene(scene, settings)), record_(record_of(scene, settings)) {
    record_.backend = "vulkan";
    record_.device = device.info().name;
    record_.driver = driver;
    samples_ = std::uint64_t{settings.samples.end - settings.samples.begin} *
               static_cast<std::uint64_t>(settings.crop_width()) *
               static_cast<std::uint64_t>(settings.crop_height());
  }

  void run(const ProgressCallback& progress) override { renderer_.render(progress); }
  std::vector<Radiance> sample(std::uint32_t index) override {
    return renderer_.render_sample(index);
  }
  Film film() const override {
    Film film = renderer_.film();
    film.record = record_;
    film.record.seconds = statistics().render_seconds;
    film.record.complete = statistics().samples == samples_;
    return film;
  }
  const RenderStatistics& statistics() const override { return renderer_.statistics(); }

 private:
  Renderer renderer_;
  RenderRecord record_;
  std::uint64_t samples_;  ///< over all pixels
};

}  // namespace

std::unique_ptr<Rendering> KernelBackend::start(const ScenePtr& scene,
                                                const RenderSettings& settings) {
  if (settings.sampling == LobeSampling::uniform)
    throw InputError("--sampling uniform belongs to --backend reference");
  return std::make_unique<KernelRendering>(device_, driver(), *scene, settings);
}

std::unique_ptr<statistics::BsdfEvaluator> KernelBackend::evaluator(const Bsdf& bsdf,
                                                                    LobeSampling sampling) {
  if (!bsdf_kernels_) bsdf_kernels_.emplace(device_);
  return std::make_unique<KernelBsdfEvaluator>(*bsdf_kernels_, bsdf, sampling);
}

}  // namespace facet
