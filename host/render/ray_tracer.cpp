#include "render/ray_tracer.h"

#include "core/clock.h"
#include "gpu/commands.h"
#include "render/features.h"

namespace facet {

namespace {

gpu::Buffer make_ray_state(gpu::Device& device, std::uint64_t records, std::size_t record_bytes) {
  return {device, records * record_bytes, "the rays"};
}

constexpr std::array tracer_bindings{shared::BINDING_items, shared::BINDING_pairs,
                                     shared::BINDING_rays, shared::BINDING_hits,
                                     shared::BINDING_counters};

}  // namespace

RayTracer::RayTracer(gpu::Device& device, const PackedScene& packed, std::uint32_t most_rays,
                     bool force_storage_buffers)
    : device_(device),
      geometry_(SceneBuffers::of_geometry(device, packed)),
      rays_(make_ray_state(device, most_rays, sizeof(shared::RayRecord))),
      hits_(make_ray_state(device, most_rays, sizeof(shared::HitRecord))),
      counters_(make_ray_state(device, shared::COUNTER_WORDS, sizeof(std::uint32_t))),
      program_(device, tracer_bindings, choose_fetch(device, packed, force_storage_buffers)),
      bound_([this] {
        gpu::BufferMap map{{shared::BINDING_rays, &rays_},
                           {shared::BINDING_hits, &hits_},
                           {shared::BINDING_counters, &counters_}};
        geometry_.add_to(map);
        return program_.bind(map);
      }()),
      closest_(program_.compile(Kernel::closest, Features{}.constants(packed.bvh.stack_size))),
      any_(program_.compile(Kernel::any, Features{}.constants(packed.bvh.stack_size))) {
  counters_.clear();
}

void RayTracer::set_rays(std::span<const shared::RayRecord> rays) {
  ray_count_ = static_cast<std::uint32_t>(rays.size());
  rays_.upload(std::as_bytes(rays));
}

double RayTracer::run(const gpu::CompiledKernel& kernel) {
  shared::PassConstants constants{};
  constants.pixel_count = ray_count_;
  const auto start = std::chrono::steady_clock::now();
  device_.run([&](gpu::Commands& c) {
    c.bind(bound_);
    c.dispatch(kernel, constants, workgroups(ray_count_));
  });
  return seconds_since(start);
}

double RayTracer::trace_closest() { return run(closest_); }

double RayTracer::trace_any() { return run(any_); }

std::vector<shared::HitRecord> RayTracer::hits() const {
  return hits_.download<shared::HitRecord>(ray_count_);
}

std::vector<bool> RayTracer::occluded() const {
  std::vector<bool> result;
  result.reserve(ray_count_);
  for (const shared::HitRecord& hit : hits()) result.push_back(hit.triangle != shared::NONE);
  return result;
}

std::uint32_t RayTracer::bound_hits() const {
  return counters_.download<std::uint32_t>(shared::COUNTER_WORDS)[shared::COUNTER_BOUND_HITS];
}

}  // namespace facet
