#include "render/renderer.h"

#include <algorithm>
#include <numeric>

#include "core/clock.h"
#include "render/resources.h"

namespace facet {

namespace {

/// An odd step near the golden section of the number of runs and coprime to it: consecutive
/// workgroups land far apart.
std::uint32_t permutation_stride(std::uint32_t runs) {
  auto stride = static_cast<std::uint32_t>(0.6180339887 * runs) | 1U;
  while (std::gcd(stride, std::max(runs, 1U)) != 1) stride += 2;
  return stride;
}

/// The sums that a record keeps as hi + lo.
std::array<double, 3> whole_sums(const shared::FilmRecord& r) {
  return {static_cast<double>(r.hi_r) + r.lo_r, static_cast<double>(r.hi_g) + r.lo_g,
          static_cast<double>(r.hi_b) + r.lo_b};
}

}  // namespace

/// One pass: samples of pixels of one piece of the film.
struct Renderer::Wave {
  std::size_t film_piece = 0;
  shared::PassConstants constants{};
};

Renderer::Renderer(gpu::Device& device, const PackedScene& packed)
    : device_(device),
      settings_(packed.settings),
      features_(packed.features),
      square_scale_(packed.frame.square_scale) {
  const auto start = std::chrono::steady_clock::now();
  resources_ = std::make_unique<Resources>(device, packed);
  // The drivers' share happens here, outside the timed render.
  resources_->compile_kernels();
  statistics_.compile_seconds = seconds_since(start);
  statistics_.kernel_instructions = resources_->instruction_count();
  statistics_.device_bytes = device.reserved_bytes();
  statistics_.bvh_seconds = packed.bvh_seconds;
  statistics_.features = features_.names();
}

Renderer::~Renderer() = default;

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
  wave.constants.film_first = resources_->film_pieces()[film_piece].first_pixel;
  return wave;
}

void Renderer::run_wave(const Wave& wave) {
  Resources& r = *resources_;
  shared::PassConstants constants = wave.constants;
  const std::uint32_t slots = constants.pixel_count * constants.sample_count;
  const std::uint32_t limit = features_.bounce_limit();
  std::uint32_t bounce = 0;
  bool more = true;
  while (more) {
    const std::uint32_t end = limit == 0 ? bounce + bounces_per_submission
                                         : std::min(limit, bounce + bounces_per_submission);
    device_.run([&](const vk::raii::CommandBuffer& c) {
      r.bind(c, wave.film_piece);
      r.start_clock(c);
      if (bounce == 0) r.clear_counters(c, slots);
      for (; bounce < end; ++bounce) {
        constants.bounce = bounce;
        constants.queue = bounce % 2;
        r.record_bounce(c, constants);
      }
    });
    r.read_clock(stage_seconds_);
    more = bounce != limit && r.read_counters()[shared::COUNTER_ACTIVE + bounce % 2] > 0;
  }
  device_.run([&](const vk::raii::CommandBuffer& c) {
    r.bind(c, wave.film_piece);
    r.start_clock(c);
    r.record_film(c, constants);
  });
  r.read_clock(stage_seconds_);
  const auto counters = r.read_counters();
  statistics_.closest_rays += counters[shared::COUNTER_CLOSEST_RAYS];
  statistics_.any_rays += counters[shared::COUNTER_ANY_RAYS];
  statistics_.bound_hits += counters[shared::COUNTER_BOUND_HITS];
  statistics_.bad_samples += counters[shared::COUNTER_BAD_SAMPLES];
  statistics_.samples += slots;
}

void Renderer::render(const ProgressCallback& progress) {
  const auto start = std::chrono::steady_clock::now();
  const Resources& r = *resources_;
  const std::uint64_t total = settings_.total_samples();
  std::uint32_t batch = 1;
  for (std::uint32_t sample = settings_.samples.begin; sample < settings_.samples.end;) {
    // Passes of 1, 1, 2, 4, ... samples give an early picture of the whole; a wave holds as many as
    // there are slots.
    const std::uint32_t done = sample - settings_.samples.begin;
    batch = std::min(std::max(done, 1U), settings_.samples.end - sample);
    for (std::size_t piece = 0; piece < r.film_pieces().size(); ++piece) {
      for (const auto& [first, count] : r.pixel_ranges(piece)) {
        const std::uint32_t per_wave = std::max(1U, r.slot_count() / count);
        for (std::uint32_t k = 0; k < batch; k += per_wave) {
          run_wave(make_wave(piece, first, count, sample + k, std::min(per_wave, batch - k)));
          statistics_.render_seconds = seconds_since(start);
          if (progress &&
              !progress(static_cast<double>(statistics_.samples) / static_cast<double>(total),
                        statistics_))
            return;
        }
      }
    }
    sample += batch;
  }
}

std::vector<Radiance> Renderer::render_sample(std::uint32_t sample) {
  const Resources& r = *resources_;
  std::vector<Radiance> radiances;
  for (std::size_t piece = 0; piece < r.film_pieces().size(); ++piece) {
    for (const auto& [first, count] : r.pixel_ranges(piece)) {
      Wave wave = make_wave(piece, first, count, sample, 1);
      // Not permuted: slots in the order of the pixels.
      wave.constants.stride = 1;
      run_wave(wave);
      for (const shared::PathRecord& path : r.read_paths(count))
        radiances.push_back({path.radiance.x, path.radiance.y, path.radiance.z});
    }
  }
  return radiances;
}

Film Renderer::film() const {
  const auto [sums, squares] = resources_->read_film();
  Film film = make_film(settings_.crop_width(), settings_.crop_height(), settings_.window(),
                        !squares.empty());
  // The squares are those of scaled values.
  const double unscale = 1 / (static_cast<double>(square_scale_) * square_scale_);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    PixelSums& pixel = film.pixels[i];
    pixel.values = whole_sums(sums[i]);
    pixel.samples = sums[i].samples;
    pixel.nonzero = sums[i].nonzero;
    if (squares.empty()) continue;
    pixel.squares = whole_sums(squares[i]);
    for (double& s : pixel.squares) s *= unscale;
  }
  return film;
}

std::vector<shared::RayRecord> Renderer::camera_rays() {
  Resources& r = *resources_;
  shared::PassConstants constants{};
  constants.pixel_count = std::min(r.slot_count(), r.pixel_count());
  constants.sample_count = 1;
  constants.stride = permutation_stride(constants.pixel_count / shared::WORKGROUP_SIZE);
  device_.run([&](const vk::raii::CommandBuffer& c) {
    r.bind(c, 0);
    r.record_camera_rays(c, constants);
  });
  return r.read_rays(constants.pixel_count);
}

}  // namespace facet
