#include "render/resources.h"

#include <algorithm>

#include "core/error.h"

namespace facet {

namespace {

using Usage = vk::BufferUsageFlagBits;

/// Paths in flight. Measured on lavapipe: 2^16 and 2^20 are both slower by a tenth and more; GPUs
/// need more to be busy.
constexpr std::uint32_t slots_on_cpu = 1U << 18U;
constexpr std::uint32_t slots_on_gpu = 1U << 20U;

/// Samples that one dispatch of film.comp adds to a pixel: Mesa 22's lavapipe silently ends loops
/// that run too long.
constexpr std::uint32_t samples_per_film_dispatch = 256;

std::uint32_t workgroups(std::uint32_t invocations) {
  return (invocations + shared::WORKGROUP_SIZE - 1) / shared::WORKGROUP_SIZE;
}

std::uint32_t choose_slots(const gpu::Device& device, const RenderSettings& settings) {
  std::uint32_t slots = settings.paths_in_flight;
  if (slots == 0) slots = device.is_cpu() ? slots_on_cpu : slots_on_gpu;
  // The largest record of a path must be bindable.
  const auto bindable =
      static_cast<std::uint32_t>(device.limits().maxStorageBufferRange / sizeof(shared::RayRecord));
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>({slots, settings.total_samples(), most_slots, bindable}));
}

std::uint32_t crop_pixels(const RenderSettings& settings) {
  return static_cast<std::uint32_t>(settings.crop_width()) *
         static_cast<std::uint32_t>(settings.crop_height());
}

/// The filter's intervals, offset and |filter| at both ends of each.
std::vector<glm::vec4> filter_intervals(const FilterTable& filter) {
  std::vector<glm::vec4> intervals;
  for (std::size_t i = 0; i + 1 < filter.quantiles.size(); ++i)
    intervals.emplace_back(filter.quantiles[i], filter.quantiles[i + 1]);
  return intervals;
}

/// What the kernels read of the scene beside the geometry, by binding from BINDING_NORMAL_INDICES
/// on.
std::vector<gpu::Buffer> make_scene_buffers(gpu::Device& device, const PackedScene& p,
                                            GeometryFetch fetch) {
  std::vector<gpu::Buffer> buffers;
  const auto add = [&](const auto& records, const char* what) {
    buffers.push_back(make_record_buffer(device, records, what, scene_usage(fetch)));
  };
  add(p.normal_indices, "the normals' indices");
  add(p.normals, "the normals");
  add(p.meshes, "the meshes");
  add(p.bsdfs, "the BSDFs");
  add(p.emitters, "the emitters");
  add(p.emitter_triangles, "the emitters' triangles");
  add(p.environment.texels, "the environment map");
  add(p.environment.rows, "the environment's rows");
  add(p.environment.columns, "the environment's columns");
  add(filter_intervals(p.filter), "the filter");
  add(p.texcoord_indices, "the texture coordinates' indices");
  add(p.texcoords, "the texture coordinates");
  add(p.textures, "the textures");
  add(p.texels, "the textures' images");
  add(p.albedos, "the tables of albedos");
  return buffers;
}

/// The first records of a buffer.
template <typename Record>
std::vector<Record> read_records(const gpu::Buffer& buffer, std::uint32_t count) {
  std::vector<Record> records(count);
  buffer.download(std::as_writable_bytes(std::span(records)));
  return records;
}

gpu::Buffer make_path_state(gpu::Device& device, std::uint64_t records, std::size_t record_bytes) {
  return {device, records * record_bytes, state_usage, "the paths in flight"};
}

}  // namespace

Renderer::Resources::Resources(gpu::Device& device, const PackedScene& packed)
    : device_(device),
      rounds_(packed.features.integrator.type.every_emitter
                  ? std::max<std::size_t>(1, packed.emitters.size())
                  : 1),
      variance_(packed.features.variance),
      pixel_count_(crop_pixels(packed.settings)),
      slot_count_(choose_slots(device, packed.settings)),
      geometry_(device, packed, packed.settings.force_storage_buffers),
      layout_(device, geometry_.binding_types(), sizeof(shared::PassConstants)),
      scene_(make_scene_buffers(device, packed, geometry_.fetch())),
      frame_(make_record_buffer(device, std::vector{packed.frame}, "the frame",
                                Usage::eUniformBuffer)),
      rays_(make_path_state(device, slot_count_, sizeof(shared::RayRecord))),
      // Hits stay in registers but between the rounds of a bounce.
      hits_(make_path_state(device, rounds_ > 1 ? slot_count_ : 0, sizeof(shared::HitRecord))),
      paths_(make_path_state(device, slot_count_, sizeof(shared::PathRecord))),
      queues_(make_path_state(device, std::uint64_t{slot_count_} * 2, sizeof(std::uint32_t))),
      counters_(device, shared::COUNTER_WORDS * sizeof(std::uint32_t),
                Usage::eStorageBuffer | Usage::eIndirectBuffer, "counters"),
      kernels_(device, layout_, packed.features, packed.bvh.stack_size, geometry_.fetch()) {
  make_film();
  bind_everything();
  if (packed.settings.time_stages) stopwatch_.emplace(device, bounces_per_submission + 1);
}

void Renderer::Resources::make_film() {
  constexpr std::uint64_t record = sizeof(shared::FilmRecord);
  const vk::PhysicalDeviceLimits& limits = device_.limits();
  const auto largest = static_cast<std::uint32_t>(
      std::min(limits.maxStorageBufferRange / record,
               limits.maxTexelBufferElements * sizeof(glm::uvec4) / record));
  for (std::uint32_t first = 0; first < pixel_count_;) {
    const std::uint32_t count = std::min(largest, pixel_count_ - first);
    pieces_.push_back({first, count});
    film_.emplace_back(device_, count * record, state_usage, "the film");
    squares_.emplace_back(device_, variance_ ? count * record : 0, state_usage,
                          "the film's variance");
    film_.back().clear();
    squares_.back().clear();
    first += count;
  }
}

void Renderer::Resources::bind_everything() {
  std::vector<gpu::Binding> bindings(shared::BUFFER_BINDING_COUNT);
  geometry_.bind(bindings);
  for (std::size_t i = 0; i < scene_.size(); ++i)
    bindings[shared::BINDING_NORMAL_INDICES + i].buffer = &scene_[i];
  bindings[shared::BINDING_FRAME].buffer = &frame_;
  bindings[shared::BINDING_RAYS].buffer = &rays_;
  bindings[shared::BINDING_HITS].buffer = &hits_;
  bindings[shared::BINDING_PATHS].buffer = &paths_;
  bindings[shared::BINDING_QUEUES].buffer = &queues_;
  bindings[shared::BINDING_COUNTERS].buffer = &counters_;
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    bindings[shared::BINDING_FILM].buffer = &film_[piece];
    bindings[shared::BINDING_FILM_SQUARES].buffer = &squares_[piece];
    sets_.emplace_back(device_, layout_, with_texels(bindings));
  }
}

std::vector<gpu::Binding> Renderer::Resources::with_texels(std::vector<gpu::Binding> bindings) {
  if (geometry_.fetch() != GeometryFetch::texel_buffer) return bindings;
  const auto view_of = [&](const gpu::Buffer& buffer) {
    return &texel_views_.emplace_back(gpu::make_texel_view(device_, buffer));
  };
  for (std::size_t i = shared::BINDING_NORMAL_INDICES; i < shared::SCENE_BINDING_COUNT; ++i)
    bindings[i].view = view_of(*bindings[i].buffer);
  for (std::size_t i = shared::BINDING_RAYS; i <= shared::BINDING_FILM_SQUARES; ++i)
    bindings.push_back({bindings[i].buffer, view_of(*bindings[i].buffer)});
  return bindings;
}

void Renderer::Resources::bind(const vk::raii::CommandBuffer& c, std::size_t film_piece) const {
  c.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_.pipeline(), 0,
                       sets_[film_piece].handle(), {});
}

void Renderer::Resources::use(const vk::raii::CommandBuffer& c, const vk::raii::Pipeline& pipeline,
                              const shared::PassConstants& constants) const {
  c.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
  c.pushConstants<shared::PassConstants>(*layout_.pipeline(), vk::ShaderStageFlagBits::eCompute, 0,
                                         constants);
}

void Renderer::Resources::clear_counters(const vk::raii::CommandBuffer& c,
                                         std::uint32_t slots) const {
  c.fillBuffer(counters_.handle(), 0, VK_WHOLE_SIZE, 0);
  gpu::barrier(c);
  c.fillBuffer(counters_.handle(), shared::COUNTER_ACTIVE * sizeof(std::uint32_t),
               sizeof(std::uint32_t), slots);
  gpu::barrier(c);
}

void Renderer::Resources::start_clock(const vk::raii::CommandBuffer& c) {
  if (stopwatch_) stopwatch_->start(c);
}

void Renderer::Resources::end_stage(const vk::raii::CommandBuffer& c, Stage stage) {
  if (stopwatch_) stopwatch_->mark(c, static_cast<std::size_t>(stage));
}

void Renderer::Resources::read_clock(std::span<double> seconds) {
  if (stopwatch_) stopwatch_->collect(seconds);
}

void Renderer::Resources::record_bounce(const vk::raii::CommandBuffer& c,
                                        const shared::PassConstants& constants) {
  use(c, kernels_.schedule(), constants);
  c.dispatch(1, 1, 1);
  gpu::barrier(c);
  shared::PassConstants round = constants;
  for (round.emitter = 0; round.emitter < rounds_; ++round.emitter) {
    use(c, kernels_.bounce(constants.bounce), round);
    c.dispatchIndirect(counters_.handle(), shared::INDIRECT_PATHS * sizeof(std::uint32_t));
    gpu::barrier(c);
  }
  end_stage(c, constants.bounce == 0 ? Stage::first_bounce : Stage::later_bounces);
}

void Renderer::Resources::record_film(const vk::raii::CommandBuffer& c,
                                      shared::PassConstants constants) {
  for (std::uint32_t k = 0; k < constants.sample_count; k += samples_per_film_dispatch) {
    constants.film_begin = k;
    constants.film_end = std::min(k + samples_per_film_dispatch, constants.sample_count);
    use(c, kernels_.film(), constants);
    c.dispatch(workgroups(constants.pixel_count), 1, 1);
    gpu::barrier(c);
  }
  end_stage(c, Stage::film);
}

void Renderer::Resources::record_camera_rays(const vk::raii::CommandBuffer& c,
                                             const shared::PassConstants& constants) {
  use(c, kernels_.camera(), constants);
  c.dispatch(workgroups(constants.pixel_count), 1, 1);
  gpu::barrier(c);
}

void Renderer::Resources::compile_kernels() {
  kernels_.compile([this](const vk::raii::Pipeline& kernel) {
    device_.run([&](const vk::raii::CommandBuffer& c) {
      shared::PassConstants nothing{};
      nothing.pixel_count = 1;
      bind(c, 0);
      clear_counters(c, 0);
      use(c, kernel, nothing);
      c.dispatch(1, 1, 1);
    });
  });
}

std::array<std::uint32_t, shared::COUNTER_WORDS> Renderer::Resources::read_counters() const {
  std::array<std::uint32_t, shared::COUNTER_WORDS> words{};
  counters_.download(std::as_writable_bytes(std::span(words)));
  return words;
}

FilmRecords Renderer::Resources::read_film() const {
  FilmRecords data;
  data.sums.resize(pixel_count_);
  if (variance_) data.squares.resize(pixel_count_);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const FilmPiece& piece = pieces_[i];
    film_[i].download(
        std::as_writable_bytes(std::span(data.sums).subspan(piece.first_pixel, piece.pixel_count)));
    if (variance_)
      squares_[i].download(std::as_writable_bytes(
          std::span(data.squares).subspan(piece.first_pixel, piece.pixel_count)));
  }
  return data;
}

std::vector<shared::RayRecord> Renderer::Resources::read_rays(std::uint32_t count) const {
  return read_records<shared::RayRecord>(rays_, count);
}

std::vector<shared::PathRecord> Renderer::Resources::read_paths(std::uint32_t count) const {
  return read_records<shared::PathRecord>(paths_, count);
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> Renderer::Resources::pixel_ranges(
    std::size_t piece) const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ranges;
  const std::uint32_t end = pieces_[piece].first_pixel + pieces_[piece].pixel_count;
  // Ranges of equal size, whole workgroups each.
  const std::uint32_t passes = (pieces_[piece].pixel_count + slot_count_ - 1) / slot_count_;
  const std::uint32_t even = (pieces_[piece].pixel_count + passes - 1) / passes;
  const std::uint32_t size =
      std::min(slot_count_, (even + shared::WORKGROUP_SIZE - 1) / shared::WORKGROUP_SIZE *
                                shared::WORKGROUP_SIZE);
  for (std::uint32_t first = pieces_[piece].first_pixel; first < end;) {
    const std::uint32_t count = std::min(size, end - first);
    ranges.emplace_back(first, count);
    first += count;
  }
  return ranges;
}

}  // namespace facet
