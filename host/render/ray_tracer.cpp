#include "render/ray_tracer.h"

#include <algorithm>
#include <array>

#include "core/clock.h"
#include "gpu/specialise.h"
#include "render/features.h"

namespace facet {

namespace {

gpu::Buffer make_ray_state(gpu::Device& device, std::uint64_t records, std::size_t record_bytes) {
  return {device, records * record_bytes, state_usage, "the rays"};
}

vk::raii::Pipeline make_pipeline(const gpu::Device& device, const gpu::Layout& layout,
                                 Kernel kernel, GeometryFetch fetch, std::uint32_t stack_size) {
  const auto code = gpu::specialise(kernel_code(kernel, fetch), Features{}.constants(stack_size),
                                    kernel_name(kernel));
  return gpu::make_compute_pipeline(device, layout, code, kernel_name(kernel));
}

}  // namespace

RayTracer::RayTracer(gpu::Device& device, const PackedScene& packed, std::uint32_t most_rays,
                     bool force_storage_buffers)
    : device_(device),
      geometry_(device, packed, force_storage_buffers),
      layout_(device, geometry_.binding_types(), sizeof(shared::PassConstants)),
      rays_(make_ray_state(device, most_rays, sizeof(shared::RayRecord))),
      hits_(make_ray_state(device, most_rays, sizeof(shared::HitRecord))),
      counters_(make_ray_state(device, shared::COUNTER_WORDS, sizeof(std::uint32_t))),
      unused_(device, sizeof(shared::FrameRecord),
              state_usage | vk::BufferUsageFlagBits::eUniformBuffer, "nothing"),
      set_(device, layout_, bindings()),
      closest_(make_pipeline(device, layout_, Kernel::closest, geometry_.fetch(),
                             packed.bvh.stack_size)),
      any_(make_pipeline(device, layout_, Kernel::any, geometry_.fetch(), packed.bvh.stack_size)) {
  counters_.clear();
}

std::vector<gpu::Binding> RayTracer::bindings() {
  const bool texels = geometry_.fetch() == GeometryFetch::texel_buffer;
  views_.reserve(shared::BINDING_COUNT);
  const auto view_of = [&](const gpu::Buffer& buffer) {
    return &views_.emplace_back(gpu::make_texel_view(device_, buffer));
  };
  std::vector<gpu::Binding> bindings(shared::BUFFER_BINDING_COUNT, {&unused_, nullptr});
  if (texels)
    std::fill_n(bindings.begin(), shared::SCENE_BINDING_COUNT,
                gpu::Binding{&unused_, view_of(unused_)});
  geometry_.bind(bindings);
  bindings[shared::BINDING_RAYS].buffer = &rays_;
  bindings[shared::BINDING_HITS].buffer = &hits_;
  bindings[shared::BINDING_COUNTERS].buffer = &counters_;
  if (!texels) return bindings;
  for (const gpu::Buffer* buffer : {&rays_, &hits_, &unused_, &unused_, &unused_})
    bindings.push_back({buffer, view_of(*buffer)});
  return bindings;
}

void RayTracer::set_rays(std::span<const shared::RayRecord> rays) {
  ray_count_ = static_cast<std::uint32_t>(rays.size());
  rays_.upload(std::as_bytes(rays));
}

double RayTracer::run(const vk::raii::Pipeline& pipeline) {
  shared::PassConstants constants{};
  constants.pixel_count = ray_count_;
  const auto start = std::chrono::steady_clock::now();
  device_.run([&](const vk::raii::CommandBuffer& c) {
    c.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
    c.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_.pipeline(), 0, set_.handle(),
                         {});
    c.pushConstants<shared::PassConstants>(*layout_.pipeline(), vk::ShaderStageFlagBits::eCompute,
                                           0, constants);
    c.dispatch((ray_count_ + shared::WORKGROUP_SIZE - 1) / shared::WORKGROUP_SIZE, 1, 1);
    gpu::barrier(c);
  });
  return seconds_since(start);
}

double RayTracer::trace_closest() { return run(closest_); }

double RayTracer::trace_any() { return run(any_); }

std::vector<shared::HitRecord> RayTracer::hits() const {
  std::vector<shared::HitRecord> records(ray_count_);
  hits_.download(std::as_writable_bytes(std::span(records)));
  return records;
}

std::vector<bool> RayTracer::occluded() const {
  std::vector<bool> result;
  result.reserve(ray_count_);
  for (const shared::HitRecord& hit : hits()) result.push_back(hit.triangle != shared::NONE);
  return result;
}

std::uint32_t RayTracer::bound_hits() const {
  std::array<std::uint32_t, shared::COUNTER_WORDS> words{};
  counters_.download(std::as_writable_bytes(std::span(words)));
  return words[shared::COUNTER_BOUND_HITS];
}

}  // namespace facet
