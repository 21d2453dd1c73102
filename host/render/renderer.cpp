#include "render/renderer.h"

#include <algorithm>
#include <numeric>

#include "core/clock.h"

namespace facet {

namespace {

/// Bounces recorded at a time at most.
constexpr std::uint32_t bounces_per_submission = 8;

/// Samples that one dispatch of film.comp adds to a pixel: Mesa 22's lavapipe silently ends loops
/// that run too long.
constexpr std::uint32_t samples_per_film_dispatch = 256;

/// An odd step near the golden section of the number of runs and coprime to it: consecutive
/// workgroups land far apart.
std::uint32_t permutation_stride(std::uint32_t runs) {
  auto stride = static_cast<std::uint32_t>(0.6180339887 * runs) | 1U;
  while (std::gcd(stride, std::max(runs, 1U)) != 1) stride += 2;
  return stride;
}

std::uint32_t crop_pixels(const RenderSettings& settings) {
  return static_cast<std::uint32_t>(settings.crop_width()) *
         static_cast<std::uint32_t>(settings.crop_height());
}

std::uint32_t rounds_of(const PackedScene& packed) {
  if (!packed.features.integrator.type.every_emitter) return 1;
  return std::max(1U, static_cast<std::uint32_t>(packed.emitters.size()));
}

std::vector<FilmBuffers> make_films(gpu::Device& device, const PackedScene& packed) {
  std::vector<FilmBuffers> films;
  // Where pixels are listed, some are of samples that are no part of the image.
  const int count = packed.features.pixel_list ? 2 : 1;
  films.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
    films.emplace_back(device, crop_pixels(packed.settings), packed.features.variance);
  return films;
}

GeometryFetch fetch_for(const gpu::Device& device, const PackedScene& packed) {
  return choose_fetch(device, packed, packed.settings.force_storage_buffers);
}

}  // namespace

Renderer::Renderer(gpu::Device& device, const PackedScene& packed)
    : Renderer(device, packed,
               std::make_shared<RenderProgram>(device, fetch_for(device, packed), packed.features,
                                               packed.bvh.stack_size)) {}

Renderer::Renderer(gpu::Device& device, const PackedScene& packed, KernelStore& store)
    : Renderer(device, packed,
               store.find_or_make(device, fetch_for(device, packed), packed.features,
                                  packed.bvh.stack_size)) {}

Renderer::Renderer(gpu::Device& device, const PackedScene& packed,
                   std::shared_ptr<RenderProgram> program)
    : device_(device),
      settings_(packed.settings),
      plan_(packed.settings.goal()),
      features_(packed.features),
      square_scale_(packed.frame.square_scale),
      seed_(packed.settings.seed),
      rounds_(rounds_of(packed)),
      scene_(device, packed),
      state_(device, choose_slots(device, packed.settings), rounds_ > 1),
      films_(make_films(device, packed)),
      listed_(
          device,
          features_.pixel_list ? image().pixel_count() * std::uint64_t{sizeof(std::uint32_t)} : 0,
          "the list of pixels"),
      program_(std::move(program)) {
  const auto start = std::chrono::steady_clock::now();
  statistics_.planned = settings_.total_samples();
  gpu::BufferMap map;
  scene_.add_to(map);
  state_.add_to(map);
  map[shared::BINDING_listed_pixels] = &listed_;
  list_pixels({});
  for (const FilmBuffers& film : films_) {
    std::vector<gpu::BoundBuffers>& bound = bound_.emplace_back();
    for (std::size_t piece = 0; piece < film.pieces().size(); ++piece) {
      film.add_to(map, piece);
      bound.push_back(program_->program.bind(map));
    }
  }
  if (packed.settings.time_stages) stopwatch_.emplace(device, bounces_per_submission + 1);
  // The drivers' share happens here, outside the timed render.
  compile_kernels();
  statistics_.compile_seconds = seconds_since(start);
  statistics_.kernel_instructions = kernels().instruction_count();
  statistics_.device_bytes = device.reserved_bytes();
  statistics_.bvh_seconds = packed.bvh_seconds;
  statistics_.features = features_.names();
}

void Renderer::compile_kernels() {
  program_->kernels.compile([this](const gpu::CompiledKernel& kernel) {
    device_.run([&](gpu::Commands& c) {
      shared::PassConstants nothing{};
      nothing.pixel_count = 1;
      c.bind(bound_.front().front());
      state_.clear_counters(c, 0);
      c.dispatch(kernel, nothing, 1);
    });
  });
}

Renderer::Wave Renderer::make_wave(std::size_t film_piece, std::uint32_t first_pixel,
                                   std::uint32_t pixel_count, std::uint32_t first_sample,
                                   std::uint32_t sample_count) const {
  Wave wave;
  wave.film_piece = film_piece;
  wave.constants.first_pixel = first_pixel;
  wave.constants.pixel_count = pixel_count;
  wave.constants.first_sample = first_sample;
  wave.constants.sample_count = sample_count;
  wave.constants.stride = permutation_stride(pixel_count / shared::WORKGROUP_SIZE);
  wave.constants.film_first = image().pieces()[film_piece].first_pixel;
  wave.constants.seed = seed_;
  wave.constants.order_bits = settings_.order_bits();
  return wave;
}

template <typename Record>
void Renderer::run_timed(const Wave& wave, const Record& record) {
  device_.run([&](gpu::Commands& c) {
    c.bind(bound_.at(static_cast<std::size_t>(wave.sums))[wave.film_piece]);
    if (stopwatch_) stopwatch_->start(c);
    record(c);
  });
  if (stopwatch_) stopwatch_->collect(stage_seconds_);
}

void Renderer::end_stage(const gpu::Commands& commands, Stage stage) {
  if (stopwatch_) stopwatch_->mark(commands, static_cast<std::size_t>(stage));
}

void Renderer::record_bounce(gpu::Commands& commands, const shared::PassConstants& constants) {
  commands.dispatch(kernels().schedule(), constants, 1);
  shared::PassConstants round = constants;
  for (round.emitter = 0; round.emitter < rounds_; ++round.emitter) {
    commands.dispatch_indirect(kernels().bounce(constants.bounce), round, state_.counters(),
                               shared::INDIRECT_PATHS * sizeof(std::uint32_t));
  }
  end_stage(commands, constants.bounce == 0 ? Stage::first_bounce : Stage::later_bounces);
}

void Renderer::record_film(gpu::Commands& commands, shared::PassConstants constants) {
  for (std::uint32_t k = 0; k < constants.sample_count; k += samples_per_film_dispatch) {
    constants.film_begin = k;
    constants.film_end = std::min(k + samples_per_film_dispatch, constants.sample_count);
    commands.dispatch(kernels().film(), constants, workgroups(constants.pixel_count));
  }
  end_stage(commands, Stage::film);
}

void Renderer::run_wave(const Wave& wave) {
  shared::PassConstants constants = wave.constants;
  const std::uint32_t slots = constants.pixel_count * constants.sample_count;
  const std::uint32_t limit = features_.bounce_limit();
  std::uint32_t bounce = 0;
  bool more = true;
  while (more) {
    const std::uint32_t end = limit == 0 ? bounce + bounces_per_submission
                                         : std::min(limit, bounce + bounces_per_submission);
    run_timed(wave, [&](gpu::Commands& c) {
      if (bounce == 0) state_.clear_counters(c, slots);
      for (; bounce < end; ++bounce) {
        constants.bounce = bounce;
        constants.queue = bounce % 2;
        record_bounce(c, constants);
      }
    });
    more = bounce != limit && state_.read_counters()[shared::COUNTER_ACTIVE + bounce % 2] > 0;
  }
  run_timed(wave, [&](gpu::Commands& c) { record_film(c, constants); });
  const Counters counters = state_.read_counters();
  statistics_.closest_rays += counters[shared::COUNTER_CLOSEST_RAYS];
  statistics_.any_rays += counters[shared::COUNTER_ANY_RAYS];
  statistics_.bound_hits += counters[shared::COUNTER_BOUND_HITS];
  statistics_.bad_samples += counters[shared::COUNTER_BAD_SAMPLES];
  statistics_.samples += slots;
}

bool Renderer::tell() {
  statistics_.render_seconds = seconds_since(start_);
  const double done =
      static_cast<double>(statistics_.samples) / static_cast<double>(statistics_.planned);
  return !progress_ || progress_(std::min(done, 1.0), statistics_);
}

void Renderer::list_pixels(const PixelList& pixels) {
  if (!features_.pixel_list) return;
  if (!pixels.empty()) {
    listed_.upload(pixels);
    return;
  }
  PixelList all(image().pixel_count());
  std::iota(all.begin(), all.end(), 0U);
  listed_.upload(all);
}

bool Renderer::run_waves(const SamplingTask& task, std::size_t film_piece, std::uint32_t& next,
                         std::uint32_t count) {
  const std::uint32_t per_wave = std::max(1U, state_.slots() / count);
  for (std::uint32_t k = task.samples.begin; k < task.samples.end; k += per_wave) {
    Wave wave = make_wave(film_piece, next, count, k, std::min(per_wave, task.samples.end - k));
    wave.sums = task.sums;
    run_wave(wave);
  }
  next += count;
  return tell();
}

bool Renderer::add_all(const SamplingTask& task, std::uint32_t& next) {
  for (std::size_t piece = 0; piece < image().pieces().size(); ++piece) {
    for (const auto& [first, count] : image().pixel_ranges(piece, state_.slots())) {
      // Whoever began may have had more slots or fewer.
      if (first + count > next && !run_waves(task, piece, next, first + count - next)) return false;
    }
  }
  return true;
}

bool Renderer::add_listed(const SamplingTask& task, std::uint32_t& next) {
  const PixelList& pixels = task.pixels;
  for (std::size_t piece = 0; piece < image().pieces().size(); ++piece) {
    const auto [first_pixel, pixel_count] = image().pieces()[piece];
    const auto last = static_cast<std::uint32_t>(
        std::lower_bound(pixels.begin(), pixels.end(), first_pixel + pixel_count) - pixels.begin());
    while (next < last) {
      if (!run_waves(task, piece, next, std::min(last - next, state_.slots()))) return false;
    }
  }
  return true;
}

bool Renderer::add(const SamplingTask& task, std::uint32_t& next) {
  seed_ = task.seed;
  list_pixels(task.pixels);
  return task.pixels.empty() ? add_all(task, next) : add_listed(task, next);
}

void Renderer::expect(double samples) {
  statistics_.planned = std::max(statistics_.samples, static_cast<std::uint64_t>(samples));
}

SamplingOutcome Renderer::render(const ProgressCallback& progress) {
  // Seconds of those who rendered before are counted as well.
  start_ = Clock::now() - duration_of(statistics_.render_seconds);
  progress_ = progress;
  return plan_.run(*this);
}

std::vector<Radiance> Renderer::render_sample(std::uint32_t sample) {
  std::vector<Radiance> radiances;
  for (std::size_t piece = 0; piece < image().pieces().size(); ++piece) {
    for (const auto& [first, count] : image().pixel_ranges(piece, state_.slots())) {
      Wave wave = make_wave(piece, first, count, sample, 1);
      // Not permuted: slots in the order of the pixels.
      wave.constants.stride = 1;
      run_wave(wave);
      for (const shared::PathRecord& path : state_.read_paths(count))
        radiances.push_back({path.radiance.x, path.radiance.y, path.radiance.z});
    }
  }
  return radiances;
}

std::vector<shared::RayRecord> Renderer::camera_rays() {
  shared::PassConstants constants{};
  constants.seed = seed_;
  constants.order_bits = settings_.order_bits();
  constants.pixel_count = std::min(state_.slots(), image().pixel_count());
  constants.sample_count = 1;
  constants.stride = permutation_stride(constants.pixel_count / shared::WORKGROUP_SIZE);
  device_.run([&](gpu::Commands& c) {
    c.bind(bound_.front().front());
    c.dispatch(program_->kernels.camera(), constants, workgroups(constants.pixel_count));
  });
  return state_.read_rays(constants.pixel_count);
}

}  // namespace facet
