#include "render/ray_tracer.h"

#include <numeric>

#include "core/clock.h"
#include "render/features.h"

namespace facet {

namespace {

gpu::Buffer make_state(gpu::Device& device, std::uint64_t records, std::size_t record_bytes) {
  return {device, records * record_bytes, record_usage, "the rays"};
}

vk::raii::Pipeline make_pipeline(const gpu::Device& device, const gpu::Layout& layout, Kernel kernel,
                                 GeometryFetch fetch, std::uint32_t stack_size) {
  return gpu::make_compute_pipeline(device, layout, kernel_code(kernel, fetch),
                                    Features{}.constants(stack_size), kernel_name(kernel));
}

}  // namespace

RayTracer::RayTracer(gpu::Device& device, const PackedScene& packed, std::uint32_t most_rays)
    : device_(device),
      geometry_(device, packed, false),
      layout_(device, geometry_.binding_types(), sizeof(shared::PassConstants)),
      rays_(make_state(device, most_rays, sizeof(shared::RayRecord))),
      hits_(make_state(device, most_rays, sizeof(shared::HitRecord))),
      paths_(make_state(device, most_rays, sizeof(shared::PathRecord))),
      shadow_rays_(make_state(device, most_rays, sizeof(shared::ShadowRayRecord))),
      queues_(make_state(device, std::uint64_t{most_rays} * 2, sizeof(std::uint32_t))),
      counters_(make_state(device, shared::COUNTER_WORDS, sizeof(std::uint32_t))),
      unused_(device, sizeof(shared::FrameRecord), record_usage | vk::BufferUsageFlagBits::eUniformBuffer,
              "nothing"),
      set_(device, layout_, bindings()),
      closest_(make_pipeline(device, layout_, Kernel::extend, geometry_.fetch(), packed.bvh.stack_size)),
      any_(make_pipeline(device, layout_, Kernel::shadow, geometry_.fetch(), packed.bvh.stack_size)) {
  std::vector<std::uint32_t> slots(most_rays);
  std::iota(slots.begin(), slots.end(), 0U);
  queues_.upload(slots);
}

std::vector<gpu::Binding> RayTracer::bindings() {
  std::vector<gpu::Binding> bindings(shared::BUFFER_BINDING_COUNT, {&unused_, nullptr});
  geometry_.bind(bindings);
  bindings[shared::BINDING_RAYS].buffer = &rays_;
  bindings[shared::BINDING_HITS].buffer = &hits_;
  bindings[shared::BINDING_PATHS].buffer = &paths_;
  bindings[shared::BINDING_SHADOW_RAYS].buffer = &shadow_rays_;
  bindings[shared::BINDING_QUEUES].buffer = &queues_;
  bindings[shared::BINDING_COUNTERS].buffer = &counters_;
  if (geometry_.fetch() != GeometryFetch::texel_buffer) return bindings;
  views_.reserve(shared::BINDING_COUNT - shared::BUFFER_BINDING_COUNT);
  for (const gpu::Buffer* buffer : {&rays_, &hits_, &paths_, &shadow_rays_, &unused_, &unused_, &unused_})
    bindings.push_back({buffer, &views_.emplace_back(gpu::make_texel_view(device_, *buffer))});
  return bindings;
}

void RayTracer::set_rays(std::span<const shared::RayRecord> rays) {
  ray_count_ = static_cast<std::uint32_t>(rays.size());
  rays_.upload(std::as_bytes(rays));
  // One for every ray that meets nothing.
  std::vector<shared::ShadowRayRecord> shadows;
  shadows.reserve(rays.size());
  for (const shared::RayRecord& r : rays)
    shadows.push_back({r.origin, r.direction, 1, 1, 1, static_cast<std::uint32_t>(shadows.size())});
  shadow_rays_.upload(shadows);
  std::vector<std::uint32_t> counters(shared::COUNTER_WORDS);
  counters[shared::COUNTER_ACTIVE] = ray_count_;
  counters[shared::COUNTER_SHADOW] = ray_count_;
  counters_.upload(counters);
}

double RayTracer::run(const vk::raii::Pipeline& pipeline) {
  const auto start = std::chrono::steady_clock::now();
  device_.run([&](const vk::raii::CommandBuffer& c) {
    c.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
    c.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_.pipeline(), 0, set_.handle(), {});
    c.pushConstants<shared::PassConstants>(*layout_.pipeline(), vk::ShaderStageFlagBits::eCompute, 0,
                                           shared::PassConstants{});
    c.dispatch((ray_count_ + shared::WORKGROUP_SIZE - 1) / shared::WORKGROUP_SIZE, 1, 1);
    gpu::barrier(c);
  });
  return seconds_since(start);
}

double RayTracer::trace_closest() { return run(closest_); }

double RayTracer::trace_any() {
  paths_.clear();
  return run(any_);
}

std::vector<shared::HitRecord> RayTracer::hits() const {
  std::vector<shared::HitRecord> records(ray_count_);
  hits_.download(std::as_writable_bytes(std::span(records)));
  return records;
}

std::vector<bool> RayTracer::occluded() const {
  std::vector<shared::PathRecord> paths(ray_count_);
  paths_.download(std::as_writable_bytes(std::span(paths)));
  std::vector<bool> result;
  result.reserve(paths.size());
  for (const shared::PathRecord& p : paths) result.push_back(p.radiance.r == 0);
  return result;
}

}  // namespace facet
