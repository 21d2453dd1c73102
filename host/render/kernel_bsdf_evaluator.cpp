#include "render/kernel_bsdf_evaluator.h"

#include <algorithm>

#include "gpu/specialise.h"
#include "render/features.h"
#include "render/kernels.h"
#include "render/pack/bsdf_record.h"
#include "scene/bsdf/albedo_table.h"

namespace facet {

using statistics::BsdfDraw;
using statistics::BsdfNumbers;
using statistics::BsdfValue;
using statistics::DirectionPair;

namespace {

/// Queries or samples of one dispatch.
constexpr std::uint32_t batch = 1U << 18U;

gpu::Buffer make_buffer(gpu::Device& device, std::uint64_t bytes) {
  return {device, bytes, vk::BufferUsageFlagBits::eStorageBuffer, "the evaluation of a BSDF"};
}

std::vector<gpu::Binding> bindings_to(const gpu::Buffer& all) {
  return std::vector<gpu::Binding>(shared::EVALUATION_BINDING_COUNT, {&all, nullptr});
}

gpu::Layout make_layout(const gpu::Device& device) {
  const std::vector<vk::DescriptorType> types(shared::EVALUATION_BINDING_COUNT,
                                              vk::DescriptorType::eStorageBuffer);
  return {device, types, sizeof(shared::PassConstants)};
}

std::array<std::uint32_t, shared::SPEC_COUNT> constants_of(const Bsdf& bsdf,
                                                           LobeSampling sampling) {
  Scene scene;
  scene.bsdfs.push_back(bsdf);
  RenderSettings settings;
  settings.sampling = sampling;
  return find_features(scene, settings).constants(1);
}

/// Calls body(first, count) for every batch.
template <typename Body>
void for_each_batch(std::size_t count, const Body& body) {
  for (std::size_t first = 0; first < count; first += batch)
    body(first, static_cast<std::uint32_t>(std::min<std::size_t>(batch, count - first)));
}

template <typename Record>
std::vector<Record> read(const gpu::Buffer& buffer, std::uint32_t count) {
  std::vector<Record> records(count);
  buffer.download(std::as_writable_bytes(std::span(records)));
  return records;
}

}  // namespace

BsdfKernels::BsdfKernels(gpu::Device& device)
    : device_(device),
      layout_(make_layout(device)),
      bsdf_(make_buffer(device, sizeof(shared::BsdfRecord))),
      albedos_(make_buffer(device, sizeof(bsdf::albedo_tables()))),
      evaluation_(make_buffer(device, sizeof(shared::EvaluationRecord))),
      queries_(make_buffer(device, batch * sizeof(shared::QueryRecord))),
      values_(make_buffer(device, batch * sizeof(glm::vec4))),
      weights_(make_buffer(device, batch * sizeof(glm::vec4))),
      unused_(make_buffer(device, 0)),
      set_([this] {
        std::vector<gpu::Binding> bindings = bindings_to(unused_);
        bindings[shared::BINDING_BSDFS].buffer = &bsdf_;
        bindings[shared::BINDING_ALBEDOS].buffer = &albedos_;
        bindings[shared::BINDING_EVALUATION].buffer = &evaluation_;
        bindings[shared::BINDING_QUERIES].buffer = &queries_;
        bindings[shared::BINDING_VALUES].buffer = &values_;
        bindings[shared::BINDING_WEIGHTS].buffer = &weights_;
        return gpu::BindingSet(device_, layout_, bindings);
      }()) {
  albedos_.upload(std::as_bytes(std::span(bsdf::albedo_tables())));
}

const BsdfKernels::Pipelines& BsdfKernels::specialised(const Constants& constants) {
  const auto found = pipelines_.find(constants);
  if (found != pipelines_.end()) return found->second;
  const auto make = [&](Kernel kernel) {
    const auto code = gpu::specialise(kernel_code(kernel, GeometryFetch::storage_buffer), constants,
                                      kernel_name(kernel));
    return gpu::make_compute_pipeline(device_, layout_, code, kernel_name(kernel));
  };
  return pipelines_.emplace(constants, Pipelines{make(Kernel::evaluate), make(Kernel::sample)})
      .first->second;
}

void BsdfKernels::run(const vk::raii::Pipeline& pipeline, std::uint32_t count) {
  device_.run([&](const vk::raii::CommandBuffer& c) {
    c.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
    c.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_.pipeline(), 0, set_.handle(),
                         {});
    c.dispatch((count + shared::WORKGROUP_SIZE - 1) / shared::WORKGROUP_SIZE, 1, 1);
    gpu::barrier(c);
  });
}

KernelBsdfEvaluator::KernelBsdfEvaluator(BsdfKernels& kernels, const Bsdf& bsdf,
                                         LobeSampling sampling)
    : kernels_(kernels),
      record_(pack_bsdf(bsdf)),
      pipelines_(kernels.specialised(constants_of(bsdf, sampling))) {}

std::vector<BsdfValue> KernelBsdfEvaluator::evaluate(std::span<const DirectionPair> pairs) {
  std::vector<BsdfValue> results;
  results.reserve(pairs.size());
  kernels_.bsdf_.upload(std::vector{record_});
  for_each_batch(pairs.size(), [&](std::size_t first, std::uint32_t count) {
    std::vector<shared::QueryRecord> queries;
    queries.reserve(count);
    for (const DirectionPair& p : pairs.subspan(first, count))
      queries.push_back({glm::vec4(p.wo, 0), glm::vec4(p.wi, 0)});
    shared::EvaluationRecord what{};
    what.count = count;
    kernels_.evaluation_.upload(std::vector{what});
    kernels_.queries_.upload(queries);
    kernels_.run(pipelines_.evaluate, count);
    for (const glm::vec4& v : read<glm::vec4>(kernels_.values_, count))
      results.push_back({vec3(v), v.w});
  });
  return results;
}

void KernelBsdfEvaluator::draw(const shared::EvaluationRecord& what, std::vector<BsdfDraw>& draws) {
  kernels_.bsdf_.upload(std::vector{record_});
  kernels_.evaluation_.upload(std::vector{what});
  kernels_.run(pipelines_.sample, what.count);
  const auto values = read<glm::vec4>(kernels_.values_, what.count);
  const auto weights = read<glm::vec4>(kernels_.weights_, what.count);
  for (std::uint32_t i = 0; i < what.count; ++i)
    draws.push_back({vec3(values[i]), values[i].w, vec3(weights[i])});
}

std::vector<BsdfDraw> KernelBsdfEvaluator::sample(const vec3& wo,
                                                  std::span<const BsdfNumbers> numbers) {
  std::vector<BsdfDraw> draws;
  draws.reserve(numbers.size());
  for_each_batch(numbers.size(), [&](std::size_t first, std::uint32_t count) {
    std::vector<shared::QueryRecord> queries;
    queries.reserve(count);
    for (const BsdfNumbers& n : numbers.subspan(first, count))
      queries.push_back({glm::vec4(n.lobe, n.u, n.v, 0), glm::vec4(0)});
    kernels_.queries_.upload(queries);
    draw({glm::vec4(wo, 0), count, 0, 0, 1}, draws);
  });
  return draws;
}

std::vector<BsdfDraw> KernelBsdfEvaluator::sample(const vec3& wo, std::uint32_t count,
                                                  std::uint32_t seed) {
  std::vector<BsdfDraw> draws;
  draws.reserve(count);
  for_each_batch(count, [&](std::size_t first, std::uint32_t n) {
    draw({glm::vec4(wo, 0), n, static_cast<std::uint32_t>(first), seed, 0}, draws);
  });
  return draws;
}

}  // namespace facet
