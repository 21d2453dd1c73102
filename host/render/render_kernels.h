#pragma once
// The kernels of a render, specialised to its scene and compiled.
#include <array>
#include <atomic>
#include <functional>
#include <mutex>
#include <optional>

#include "render/bindings.h"
#include "render/features.h"

namespace facet {

class RenderKernels {
 public:
  /// Runs a kernel once, on a pass without work.
  using Warming = std::function<void(const gpu::CompiledKernel&)>;

  /// Nothing is compiled yet. The program has to outlive this.
  RenderKernels(const KernelProgram& program, const Features& features, std::uint32_t stack_size);

  /// Compiles all kernels that the integrator needs, unless that is done, beside each other, and
  /// calls `warm` with each as soon as there is one, never two at a time: many drivers compile at
  /// the first dispatch, one kernel after the other, and would else begin with it only when the
  /// last is ready. Throws DeviceError.
  void compile(const Warming& warm);

  [[nodiscard]] const gpu::CompiledKernel& schedule() const { return *schedule_; }
  /// By the bounce's index, from 0 on.
  [[nodiscard]] const gpu::CompiledKernel& bounce(std::uint32_t index) const;
  [[nodiscard]] const gpu::CompiledKernel& film() const { return *film_; }
  /// For the camera's rays alone; compiled when first asked for.
  [[nodiscard]] const gpu::CompiledKernel& camera();

  /// Of all kernels so far, in SPIR-V.
  [[nodiscard]] std::uint64_t instruction_count() const { return instructions_; }

 private:
  /// What a kernel for a bounce is specialised to.
  struct BounceKind {
    bool camera;
    bool last;
    [[nodiscard]] std::size_t index() const { return (camera ? 1U : 0U) + (last ? 2U : 0U); }
  };
  [[nodiscard]] BounceKind kind_of(std::uint32_t bounce) const;
  [[nodiscard]] gpu::CompiledKernel make(Kernel kernel, BounceKind kind = {});

  const KernelProgram& program_;
  Features features_;
  std::uint32_t stack_size_;
  std::optional<gpu::CompiledKernel> schedule_;
  std::array<std::optional<gpu::CompiledKernel>, 4> bounces_;  ///< by BounceKind::index
  std::optional<gpu::CompiledKernel> film_;
  std::optional<gpu::CompiledKernel> camera_;
  std::atomic<std::uint64_t> instructions_ = 0;
  bool compiled_ = false;
};

}  // namespace facet
