#include "render/kernel_bsdf_evaluator.h"

#include <algorithm>

#include "gpu/commands.h"
#include "render/features.h"
#include "render/pack/parameter_records.h"
#include "scene/bsdf/albedo_table.h"

namespace facet {

using statistics::BsdfDraw;
using statistics::BsdfNumbers;
using statistics::BsdfQuery;
using statistics::BsdfValue;
using statistics::DirectionPair;

namespace {

/// Queries or samples of one dispatch.
constexpr std::uint32_t batch = 1U << 18U;

gpu::Buffer make_buffer(gpu::Device& device, std::uint64_t bytes) {
  return {device, bytes, "the evaluation of a BSDF"};
}

constexpr std::array evaluation_bindings{shared::BINDING_bsdfs,       shared::BINDING_albedos,
                                         shared::BINDING_evaluations, shared::BINDING_queries,
                                         shared::BINDING_values,      shared::BINDING_weights};

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

}  // namespace

BsdfKernels::BsdfKernels(gpu::Device& device)
    : device_(device),
      bsdf_(make_buffer(device, sizeof(shared::BsdfRecord))),
      albedos_(make_buffer(device, sizeof(bsdf::albedo_tables()))),
      evaluation_(make_buffer(device, sizeof(shared::EvaluationRecord))),
      queries_(make_buffer(device, batch * sizeof(shared::QueryRecord))),
      values_(make_buffer(device, batch * sizeof(glm::vec4))),
      weights_(make_buffer(device, batch * sizeof(glm::vec4))),
      program_(device, evaluation_bindings, GeometryFetch::storage_buffer),
      bound_(program_.bind({{shared::BINDING_bsdfs, &bsdf_},
                            {shared::BINDING_albedos, &albedos_},
                            {shared::BINDING_evaluations, &evaluation_},
                            {shared::BINDING_queries, &queries_},
                            {shared::BINDING_values, &values_},
                            {shared::BINDING_weights, &weights_}})) {
  albedos_.upload(std::as_bytes(std::span(bsdf::albedo_tables())));
}

const BsdfKernels::Pair& BsdfKernels::specialised(const Constants& constants) {
  const auto found = kernels_.find(constants);
  if (found != kernels_.end()) return found->second;
  Pair pair{program_.compile(Kernel::evaluate, constants),
            program_.compile(Kernel::sample, constants)};
  return kernels_.emplace(constants, std::move(pair)).first->second;
}

void BsdfKernels::run(const gpu::CompiledKernel& kernel, std::uint32_t count) {
  device_.run([&](gpu::Commands& c) {
    c.bind(bound_);
    c.dispatch(kernel, shared::PassConstants{}, workgroups(count));
  });
}

KernelBsdfEvaluator::KernelBsdfEvaluator(BsdfKernels& kernels, const Bsdf& bsdf,
                                         LobeSampling sampling)
    : kernels_(kernels),
      record_(pack_bsdf(bsdf)),
      pair_(kernels.specialised(constants_of(bsdf, sampling))) {}

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
    kernels_.run(pair_.evaluate, count);
    for (const glm::vec4& v : kernels_.values_.download<glm::vec4>(count))
      results.push_back({vec3(v), v.w});
  });
  return results;
}

void KernelBsdfEvaluator::draw(const shared::EvaluationRecord& what, std::vector<BsdfDraw>& draws) {
  kernels_.bsdf_.upload(std::vector{record_});
  kernels_.evaluation_.upload(std::vector{what});
  kernels_.run(pair_.sample, what.count);
  const auto values = kernels_.values_.download<glm::vec4>(what.count);
  const auto weights = kernels_.weights_.download<glm::vec4>(what.count);
  for (std::uint32_t i = 0; i < what.count; ++i)
    draws.push_back({vec3(values[i]), values[i].w, vec3(weights[i])});
}

std::vector<BsdfDraw> KernelBsdfEvaluator::sample(const vec3& wo,
                                                  std::span<const BsdfNumbers> numbers) {
  std::vector<BsdfQuery> queries;
  queries.reserve(numbers.size());
  for (const BsdfNumbers& n : numbers) queries.push_back({wo, n});
  return sample(queries);
}

std::vector<BsdfDraw> KernelBsdfEvaluator::sample(std::span<const BsdfQuery> queries) {
  std::vector<BsdfDraw> draws;
  draws.reserve(queries.size());
  for_each_batch(queries.size(), [&](std::size_t first, std::uint32_t count) {
    std::vector<shared::QueryRecord> records;
    records.reserve(count);
    for (const BsdfQuery& q : queries.subspan(first, count))
      records.push_back(
          {glm::vec4(q.numbers.lobe, q.numbers.u, q.numbers.v, 0), glm::vec4(q.wo, 0)});
    kernels_.queries_.upload(records);
    draw({glm::vec4(0), count, 0, 0, 1}, draws);
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
