#include "render/render_kernels.h"

#include <future>
#include <vector>

namespace facet {

RenderKernels::RenderKernels(const KernelProgram& program, const Features& features,
                             std::uint32_t stack_size)
    : program_(program), features_(features), stack_size_(stack_size) {}

RenderKernels::BounceKind RenderKernels::kind_of(std::uint32_t bounce) const {
  return {bounce == 0, features_.is_last_bounce(bounce)};
}

const gpu::CompiledKernel& RenderKernels::bounce(std::uint32_t index) const {
  return bounces_[kind_of(index).index()].value();
}

const gpu::CompiledKernel& RenderKernels::camera() {
  if (!camera_) camera_ = make(Kernel::camera);
  return *camera_;
}

gpu::CompiledKernel RenderKernels::make(Kernel kernel, BounceKind kind) {
  auto constants = features_.constants(stack_size_);
  constants[shared::SPEC_CAMERA_BOUNCE] = kind.camera ? 1 : 0;
  constants[shared::SPEC_LAST_BOUNCE] = kind.last ? 1 : 0;
  gpu::CompiledKernel compiled = program_.compile(kernel, constants);
  instructions_ += compiled.instruction_count();
  return compiled;
}

void RenderKernels::compile(const Warming& warm) {
  if (compiled_) return;
  std::mutex warming;
  std::vector<std::future<void>> jobs;
  const auto start = [&](std::optional<gpu::CompiledKernel>& pipeline, Kernel kernel,
                         BounceKind kind = {}) {
    // A thread each: most of the time all but one wait for the driver.
    jobs.push_back(std::async(std::launch::async, [&, kernel, kind] {
      pipeline = make(kernel, kind);
      const std::scoped_lock lock(warming);
      warm(*pipeline);
    }));
  };
  const std::uint32_t limit = features_.bounce_limit();
  // The first, one in between, and the last, as far as there are such.
  std::vector<BounceKind> kinds{kind_of(0)};
  if (limit != 1) kinds.push_back(kind_of(1));
  if (limit > 2 && kind_of(limit - 1).last && !kind_of(1).last) kinds.push_back(kind_of(limit - 1));
  for (const BounceKind kind : kinds) start(bounces_[kind.index()], Kernel::bounce, kind);
  start(schedule_, Kernel::schedule);
  start(film_, Kernel::film);
  for (std::future<void>& job : jobs) job.get();
  compiled_ = true;
}

}  // namespace facet
