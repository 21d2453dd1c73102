#include "render/render_kernels.h"

#include <future>
#include <vector>

#include "gpu/specialise.h"

namespace facet {

RenderKernels::RenderKernels(const gpu::Device& device, const gpu::Layout& layout,
                             const Features& features, std::uint32_t stack_size,
                             GeometryFetch fetch)
    : device_(device),
      layout_(layout),
      features_(features),
      stack_size_(stack_size),
      fetch_(fetch) {}

RenderKernels::BounceKind RenderKernels::kind_of(std::uint32_t bounce) const {
  return {bounce == 0, features_.is_last_bounce(bounce)};
}

const vk::raii::Pipeline& RenderKernels::bounce(std::uint32_t index) const {
  return bounces_[kind_of(index).index()].value();
}

const vk::raii::Pipeline& RenderKernels::camera() {
  if (!camera_) camera_ = make(Kernel::camera);
  return *camera_;
}

vk::raii::Pipeline RenderKernels::make(Kernel kernel, BounceKind kind) {
  auto constants = features_.constants(stack_size_);
  constants[shared::SPEC_CAMERA_BOUNCE] = kind.camera ? 1 : 0;
  constants[shared::SPEC_LAST_BOUNCE] = kind.last ? 1 : 0;
  const auto code = gpu::specialise(kernel_code(kernel, fetch_), constants, kernel_name(kernel));
  instructions_ += gpu::instruction_count(code);
  return gpu::make_compute_pipeline(device_, layout_, code, kernel_name(kernel));
}

void RenderKernels::compile(const Warming& warm) {
  std::mutex warming;
  std::vector<std::future<void>> jobs;
  const auto start = [&](std::optional<vk::raii::Pipeline>& pipeline, Kernel kernel,
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
}

}  // namespace facet
