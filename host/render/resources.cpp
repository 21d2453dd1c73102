#include "render/resources.h"

#include <algorithm>

#include "core/error.h"

namespace facet {

namespace {

using Usage = vk::BufferUsageFlagBits;

/// Paths in flight. Measured on lavapipe: 2^16 and 2^20 are both slower by a tenth and more; GPUs need more
/// to be busy.
constexpr std::uint32_t slots_on_cpu = 1U << 18U;
constexpr std::uint32_t slots_on_gpu = 1U << 20U;

std::uint32_t choose_slots(const gpu::Device& device, const RenderSettings& settings, std::uint64_t paths) {
  std::uint32_t slots = settings.paths_in_flight;
  if (slots == 0) slots = device.is_cpu() ? slots_on_cpu : slots_on_gpu;
  // The largest record of a path must be bindable.
  const auto bindable =
      static_cast<std::uint32_t>(device.limits().maxStorageBufferRange / sizeof(shared::ShadowRayRecord));
  return static_cast<std::uint32_t>(std::min<std::uint64_t>({slots, paths, most_slots, bindable}));
}

std::uint32_t crop_pixels(const Crop& crop) {
  return static_cast<std::uint32_t>(crop.x1 - crop.x0) * static_cast<std::uint32_t>(crop.y1 - crop.y0);
}

/// The frame with what the settings say.
shared::FrameRecord complete_frame(const PackedScene& packed, const Features& features,
                                   const RenderSettings& settings) {
  shared::FrameRecord frame = packed.frame;
  frame.crop_x = static_cast<std::uint32_t>(settings.crop.x0);
  frame.crop_y = static_cast<std::uint32_t>(settings.crop.y0);
  frame.crop_width = static_cast<std::uint32_t>(settings.crop.x1 - settings.crop.x0);
  frame.crop_height = static_cast<std::uint32_t>(settings.crop.y1 - settings.crop.y0);
  frame.seed = settings.seed;
  const int limit = features.integrator.interaction_limit();
  frame.max_depth = limit < 0 ? shared::NONE : static_cast<std::uint32_t>(limit);
  return frame;
}

/// What the kernels read beside the geometry, by binding from BINDING_NORMAL_INDICES on.
std::vector<gpu::Buffer> make_scene_buffers(gpu::Device& device, const PackedScene& p,
                                            const Features& features, const RenderSettings& settings) {
  const std::vector<shared::FrameRecord> frame{complete_frame(p, features, settings)};
  std::vector<gpu::Buffer> buffers;
  buffers.push_back(make_record_buffer(device, p.normal_indices, "the normals' indices"));
  buffers.push_back(make_record_buffer(device, p.normals, "the normals"));
  buffers.push_back(make_record_buffer(device, p.meshes, "the meshes", record_usage));
  buffers.push_back(make_record_buffer(device, p.bsdfs, "the BSDFs", record_usage));
  buffers.push_back(make_record_buffer(device, p.emitters, "the emitters", record_usage));
  buffers.push_back(make_record_buffer(device, p.emitter_triangles, "the emitters' triangles"));
  buffers.push_back(make_record_buffer(device, p.environment.texels, "the environment map"));
  buffers.push_back(make_record_buffer(device, p.environment.rows, "the environment's rows"));
  buffers.push_back(make_record_buffer(device, p.environment.columns, "the environment's columns"));
  buffers.push_back(make_record_buffer(device, p.filter.quantiles, "the filter"));
  buffers.push_back(make_record_buffer(device, p.texcoord_indices, "the texture coordinates' indices"));
  buffers.push_back(make_record_buffer(device, p.texcoords, "the texture coordinates"));
  buffers.push_back(make_record_buffer(device, p.textures, "the textures"));
  buffers.push_back(make_record_buffer(device, p.texels, "the textures' images"));
  buffers.push_back(make_record_buffer(device, p.albedos, "the tables of albedos"));
  buffers.push_back(make_record_buffer(device, frame, "the frame", Usage::eUniformBuffer));
  return buffers;
}

/// The first records of a buffer.
template <typename Record>
std::vector<Record> read_records(const gpu::Buffer& buffer, std::uint32_t count) {
  std::vector<Record> records(count);
  buffer.download(std::as_writable_bytes(std::span(records)));
  return records;
}

gpu::Buffer make_state(gpu::Device& device, std::uint64_t records, std::size_t record_bytes) {
  return {device, records * record_bytes, record_usage, "the paths in flight"};
}

}  // namespace

Renderer::Resources::Resources(gpu::Device& device, const PackedScene& packed, const Features& features,
                               const RenderSettings& settings)
    : device_(device),
      shadow_rays_(features.integrator.type.emitter_sampling || features.integrator.type.name == "ao" ||
                   features.integrator.type.name == "simple"),
      rounds_(features.integrator.type.every_emitter ? std::max<std::size_t>(1, packed.emitters.size()) : 1),
      variance_(features.variance),
      pixel_count_(crop_pixels(settings.crop)),
      slot_count_(choose_slots(device, settings,
                               std::uint64_t{pixel_count_} * (settings.end_sample - settings.first_sample))),
      geometry_(device, packed, settings.force_storage_buffers),
      layout_(device, geometry_.binding_types(), sizeof(shared::PassConstants)),
      scene_(make_scene_buffers(device, packed, features, settings)),
      rays_(make_state(device, slot_count_, sizeof(shared::RayRecord))),
      hits_(make_state(device, slot_count_, sizeof(shared::HitRecord))),
      paths_(make_state(device, slot_count_, sizeof(shared::PathRecord))),
      shadow_(make_state(device, shadow_rays_ ? slot_count_ : 0, sizeof(shared::ShadowRayRecord))),
      queues_(make_state(device, std::uint64_t{slot_count_} * 2, sizeof(std::uint32_t))),
      counters_(device, shared::COUNTER_WORDS * sizeof(std::uint32_t),
                Usage::eStorageBuffer | Usage::eIndirectBuffer, "counters") {
  make_film();
  bind_everything();
  if (settings.time_stages) {
    const std::size_t marks_of_bounce = 1 + 2 * rounds_;
    stopwatch_.emplace(device, static_cast<std::uint32_t>(1 + marks_of_bounce * bounces_per_submission));
  }
  const auto constants = features.constants(packed.bvh.stack_size);
  for (int k = 0; k < render_kernel_count; ++k) {
    const auto kernel = static_cast<Kernel>(k);
    pipelines_.push_back(gpu::make_compute_pipeline(device, layout_, kernel_code(kernel, geometry_.fetch()),
                                                    constants, kernel_name(kernel)));
  }
}

void Renderer::Resources::make_film() {
  constexpr std::uint64_t record = sizeof(shared::FilmRecord);
  const auto largest = static_cast<std::uint32_t>(device_.limits().maxStorageBufferRange / record);
  for (std::uint32_t first = 0; first < pixel_count_;) {
    const std::uint32_t count = std::min(largest, pixel_count_ - first);
    pieces_.push_back({first, count});
    film_.emplace_back(device_, count * record, Usage::eStorageBuffer, "the film");
    squares_.emplace_back(device_, variance_ ? count * record : 0, Usage::eStorageBuffer,
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
  bindings[shared::BINDING_RAYS].buffer = &rays_;
  bindings[shared::BINDING_HITS].buffer = &hits_;
  bindings[shared::BINDING_PATHS].buffer = &paths_;
  bindings[shared::BINDING_SHADOW_RAYS].buffer = &shadow_;
  bindings[shared::BINDING_QUEUES].buffer = &queues_;
  bindings[shared::BINDING_COUNTERS].buffer = &counters_;
  bind_texels(bindings);
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    bindings[shared::BINDING_FILM].buffer = &film_[piece];
    bindings[shared::BINDING_FILM_SQUARES].buffer = &squares_[piece];
    sets_.emplace_back(device_, layout_, bindings);
  }
}

void Renderer::Resources::bind_texels(std::vector<gpu::Binding>& bindings) {
  if (geometry_.fetch() != GeometryFetch::texel_buffer) return;
  texel_views_.reserve(shared::BINDING_COUNT - shared::BUFFER_BINDING_COUNT);
  for (const std::uint32_t records :
       {shared::BINDING_RAYS, shared::BINDING_HITS, shared::BINDING_PATHS, shared::BINDING_SHADOW_RAYS,
        shared::BINDING_MESHES, shared::BINDING_BSDFS, shared::BINDING_EMITTERS}) {
    const gpu::Buffer* buffer = bindings[records].buffer;
    bindings.push_back({buffer, &texel_views_.emplace_back(gpu::make_texel_view(device_, *buffer))});
  }
}

void Renderer::Resources::bind(const vk::raii::CommandBuffer& c, std::size_t film_piece) const {
  c.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_.pipeline(), 0, sets_[film_piece].handle(),
                       {});
}

void Renderer::Resources::dispatch(const vk::raii::CommandBuffer& c, Kernel kernel,
                                   const shared::PassConstants& constants, std::uint32_t groups) const {
  c.bindPipeline(vk::PipelineBindPoint::eCompute, *pipelines_[static_cast<std::size_t>(kernel)]);
  c.pushConstants<shared::PassConstants>(*layout_.pipeline(), vk::ShaderStageFlagBits::eCompute, 0,
                                         constants);
  c.dispatch(groups, 1, 1);
}

void Renderer::Resources::dispatch_indirect(const vk::raii::CommandBuffer& c, Kernel kernel,
                                            const shared::PassConstants& constants,
                                            std::uint32_t counter_word) const {
  c.bindPipeline(vk::PipelineBindPoint::eCompute, *pipelines_[static_cast<std::size_t>(kernel)]);
  c.pushConstants<shared::PassConstants>(*layout_.pipeline(), vk::ShaderStageFlagBits::eCompute, 0,
                                         constants);
  c.dispatchIndirect(counters_.handle(), counter_word * sizeof(std::uint32_t));
}

void Renderer::Resources::clear_counters(const vk::raii::CommandBuffer& c, std::uint32_t slots) const {
  c.fillBuffer(counters_.handle(), 0, VK_WHOLE_SIZE, 0);
  gpu::barrier(c);
  c.fillBuffer(counters_.handle(), shared::COUNTER_ACTIVE * sizeof(std::uint32_t), sizeof(std::uint32_t),
               slots);
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
  shared::PassConstants stage = constants;
  dispatch(c, Kernel::schedule, stage, 1);
  gpu::barrier(c);
  dispatch_indirect(c, Kernel::extend, constants, shared::INDIRECT_PATHS);
  gpu::barrier(c);
  end_stage(c, Stage::extend);
  for (std::uint32_t emitter = 0; emitter < rounds_; ++emitter) {
    stage.emitter = emitter;
    if (emitter > 0) {
      stage.stage = 2;
      dispatch(c, Kernel::schedule, stage, 1);
      gpu::barrier(c);
    }
    dispatch_indirect(c, Kernel::shade, stage, shared::INDIRECT_PATHS);
    gpu::barrier(c);
    end_stage(c, Stage::shade);
    if (!shadow_rays_) continue;
    stage.stage = 1;
    dispatch(c, Kernel::schedule, stage, 1);
    gpu::barrier(c);
    dispatch_indirect(c, Kernel::shadow, constants, shared::INDIRECT_SHADOW);
    gpu::barrier(c);
    end_stage(c, Stage::shadow);
  }
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
      squares_[i].download(
          std::as_writable_bytes(std::span(data.squares).subspan(piece.first_pixel, piece.pixel_count)));
  }
  return data;
}

std::vector<shared::RayRecord> Renderer::Resources::read_rays(std::uint32_t count) const {
  return read_records<shared::RayRecord>(rays_, count);
}

std::vector<shared::HitRecord> Renderer::Resources::read_hits(std::uint32_t count) const {
  return read_records<shared::HitRecord>(hits_, count);
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
  const std::uint32_t size = std::min(
      slot_count_, (even + shared::WORKGROUP_SIZE - 1) / shared::WORKGROUP_SIZE * shared::WORKGROUP_SIZE);
  for (std::uint32_t first = pieces_[piece].first_pixel; first < end;) {
    const std::uint32_t count = std::min(size, end - first);
    ranges.emplace_back(first, count);
    first += count;
  }
  return ranges;
}

}  // namespace facet
