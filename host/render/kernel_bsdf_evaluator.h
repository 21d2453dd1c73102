#pragma once
// One BSDF on the device, evaluated and sampled by the renderer's own shaders.
#include <map>

#include "render/bindings.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "statistics/bsdf_evaluator.h"

namespace facet {

/// The kernels that evaluate BSDFs, compiled once for BSDFs of the same features, and what they
/// work on.
class BsdfKernels {
 public:
  explicit BsdfKernels(gpu::Device& device);

 private:
  friend class KernelBsdfEvaluator;
  using Constants = std::array<std::uint32_t, shared::SPEC_COUNT>;
  struct Pair {
    gpu::CompiledKernel evaluate;
    gpu::CompiledKernel sample;
  };

  /// For a scene with this BSDF alone.
  const Pair& specialised(const Constants& constants);
  /// Runs a kernel over the first `count` records that are bound.
  void run(const gpu::CompiledKernel& kernel, std::uint32_t count);

  gpu::Device& device_;
  gpu::Buffer bsdf_;
  gpu::Buffer albedos_;
  gpu::Buffer evaluation_;
  gpu::Buffer queries_;
  gpu::Buffer values_;
  gpu::Buffer weights_;
  KernelProgram program_;
  gpu::BoundBuffers bound_;
  std::map<Constants, Pair> kernels_;
};

/// A BSDF without textures, by the kernels specialised to a scene that has nothing else.
class KernelBsdfEvaluator : public statistics::BsdfEvaluator {
 public:
  /// sampling: ndf or visible. `kernels` must outlive this and may be shared, though not between
  /// threads.
  KernelBsdfEvaluator(BsdfKernels& kernels, const Bsdf& bsdf, LobeSampling sampling);

  [[nodiscard]] std::vector<statistics::BsdfValue> evaluate(
      std::span<const statistics::DirectionPair> pairs) override;
  [[nodiscard]] std::vector<statistics::BsdfDraw> sample(
      const vec3& wo, std::span<const statistics::BsdfNumbers> numbers) override;
  /// One sample for each query: a dispatch for many directions of view.
  [[nodiscard]] std::vector<statistics::BsdfDraw> sample(
      std::span<const statistics::BsdfQuery> queries);
  [[nodiscard]] std::vector<statistics::BsdfDraw> sample(const vec3& wo, std::uint32_t count,
                                                         std::uint32_t seed) override;

 private:
  /// Samples as the record says, and appends them.
  void draw(const shared::EvaluationRecord& what, std::vector<statistics::BsdfDraw>& draws);

  BsdfKernels& kernels_;
  shared::BsdfRecord record_;
  const BsdfKernels::Pair& pair_;
};

}  // namespace facet
