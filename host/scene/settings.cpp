#include "scene/settings.h"

#include <algorithm>
#include <cmath>

#include "convergence/probes.h"
#include "core/error.h"
#include "image/division.h"
#include "scene/fingerprint.h"
#include "scene/reader.h"
#include "version.h"

namespace facet {

namespace {

template <typename Names>
[[noreturn]] void fail_unknown(const char* what, const std::string& name, const Names& known) {
  const std::vector<std::string> names(known.begin(), known.end());
  throw InputError(fmt::format("{} \"{}\": unknown{}; there are: {}", what, name,
                               did_you_mean(name, names), fmt::join(names, ", ")));
}

Integrator integrator_of(const Scene& scene, const RenderRequest& request) {
  Integrator integrator = scene.integrator;
  if (request.integrator) {
    const auto type = find_integrator_type(*request.integrator);
    if (!type) {
      std::vector<std::string_view> names;
      for (const IntegratorType& t : integrator_types()) names.push_back(t.name);
      fail_unknown("integrator", *request.integrator, names);
    }
    integrator.type = *type;
  }
  if (integrator.type.name.empty())
    throw InputError(
        fmt::format("{}: the scene has no integrator, and none is asked for (on the command line: "
                    "--integrator)",
                    scene.file.string()));
  if (request.max_depth) {
    if (*request.max_depth < -1)
      throw InputError(
          fmt::format("maximum depth {}: -1 (unlimited) or more expected", *request.max_depth));
    integrator.max_depth = *request.max_depth;
  }
  if (request.heuristic) integrator.heuristic = *request.heuristic;
  if (request.emitter_selection) integrator.emitter_selection = *request.emitter_selection;
  if (request.area_sampling) integrator.area_sampling = *request.area_sampling;
  if (request.environment_sampling) integrator.environment_sampling = *request.environment_sampling;
  if (request.emitter_candidates) {
    constexpr auto most = static_cast<int>(shared::LARGEST_CANDIDATES);
    if (*request.emitter_candidates < 1 || *request.emitter_candidates > most)
      throw InputError(fmt::format("{} candidates of an emitter sample: 1 to {} expected",
                                   *request.emitter_candidates, most));
    integrator.emitter_candidates = *request.emitter_candidates;
  }
  return integrator;
}

Sampler sampler_of(const Scene& scene, const RenderRequest& request) {
  if (!request.sampler) return scene.sampler;
  const auto sampler = find_sampler(*request.sampler);
  if (!sampler) fail_unknown("sampler", *request.sampler, sampler_names);
  return *sampler;
}

Crop crop_of(const ImageSize& size, const RenderRequest& request) {
  if (request.crop && request.pixel) throw InputError("crop and pixel exclude each other");
  Crop c{0, 0, size.width, size.height};
  std::string asked;
  if (request.crop) {
    c = *request.crop;
    asked = fmt::format("crop {},{},{},{}", c.x0, c.y0, c.x1, c.y1);
  } else if (request.pixel) {
    const auto [x, y] = *request.pixel;
    c = {x, y, x + 1, y + 1};
    asked = fmt::format("pixel {},{}", x, y);
  }
  if (c.x0 < 0 || c.y0 < 0 || c.x0 >= c.x1 || c.y0 >= c.y1 || c.x1 > size.width ||
      c.y1 > size.height)
    throw InputError(fmt::format("{} lies outside the image of {}x{} pixels or is empty", asked,
                                 size.width, size.height));
  return c;
}

/// The caller's number of samples a pixel, or else `otherwise`.
std::uint32_t sample_count_of(const RenderRequest& request, std::uint32_t otherwise) {
  if (!request.samples) return otherwise;
  const int count = *request.samples;
  if (count < 1 || count > static_cast<int>(largest_sample_count))
    throw InputError(
        fmt::format("{} samples a pixel: 1 to {} expected", count, largest_sample_count));
  return static_cast<std::uint32_t>(count);
}

SampleRange samples_of(const Scene& scene, const RenderRequest& request) {
  if (request.sample_range) {
    const SampleRange& range = *request.sample_range;
    if (range.begin >= range.end || range.end > largest_sample_count)
      throw InputError(
          fmt::format("sample range {}:{}: empty or too large", range.begin, range.end));
    return range;
  }
  const bool open_ended = request.error || request.deadline;
  const auto otherwise = static_cast<std::uint32_t>(scene.sample_count);
  return {0, sample_count_of(request, open_ended ? largest_sample_count : otherwise)};
}

void check_share(const char* what, const Share& share, std::uint64_t things, const char* of) {
  if (share.index < 1 || share.index > share.count)
    throw InputError(fmt::format("{} {} of {}: from 1 to {} expected", what, share.index,
                                 share.count, share.count));
  if (share.count > things)
    throw InputError(fmt::format("{} {} of {}: more shares than {}, {}", what, share.index,
                                 share.count, of, things));
}

/// Leaves the samples and pixels that the request's shares hold.
void divide(RenderSettings& s, const RenderRequest& request) {
  if (!request.part && !request.tile) return;
  if (request.part && request.sample_range)
    throw InputError("a part and a sample range exclude each other");
  if (request.tile && request.pixel) throw InputError("a tile and a pixel exclude each other");
  Division& d = s.division.emplace();
  d.samples = s.samples;
  d.pixels = s.crop;
  if (request.part) {
    check_share("part", *request.part, s.samples_per_pixel(), "samples a pixel");
    d.parts = request.part->count;
    s.samples = share_of(s.samples, *request.part);
  }
  if (request.tile) {
    check_share("tile", *request.tile, static_cast<std::uint64_t>(s.crop_height()),
                "rows of pixels");
    d.tiles = request.tile->count;
    s.crop = share_of(s.crop, *request.tile);
  }
  if (std::uint64_t{d.parts} * d.tiles > most_shares)
    throw InputError(
        fmt::format("{} parts of {} tiles: {} shares at most", d.parts, d.tiles, most_shares));
}

void check_goals(const RenderSettings& s) {
  if (s.adaptive && s.is_part)
    throw InputError(
        "adaptive sampling and a sample range, a part or a tile exclude each other: the pixels of "
        "parts have the same samples");
  if ((s.error || s.deadline) && s.is_part)
    throw InputError(
        "a sample range, a part or a tile says which samples are rendered; an error or a time to "
        "stop at would leave some of them away");
  if (s.error && !(*s.error > 0 && std::isfinite(*s.error)))
    throw InputError(fmt::format("an error of {}: a positive number expected", *s.error));
  if (s.adaptive && s.samples_per_pixel() < least_adaptive_samples)
    throw InputError(fmt::format("{} samples a pixel: adaptive sampling needs at least {}",
                                 s.samples_per_pixel(), least_adaptive_samples));
}

}  // namespace

RenderSettings resolve(const Scene& scene, const RenderRequest& request) {
  RenderSettings s;
  s.integrator = integrator_of(scene, request);
  s.sampler = sampler_of(scene, request);
  s.size = request.size.value_or(ImageSize{scene.camera.width, scene.camera.height});
  check_image_size(s.size.width, s.size.height);
  s.crop = crop_of(s.size, request);
  s.samples = samples_of(scene, request);
  divide(s, request);
  s.is_part = request.sample_range || s.division;
  s.planned = sample_count_of(request, static_cast<std::uint32_t>(scene.sample_count));
  s.seed = request.seed.value_or(scene.seed);
  s.masking = request.masking;
  s.sampling = request.sampling;
  s.adaptive = request.adaptive;
  s.error = request.error;
  s.deadline = request.deadline;
  const bool estimated = request.estimate_error || s.error;
  s.variance = request.variance || s.adaptive || estimated;
  s.probes = estimated && !is_independent(s.sampler) && has_probes(s.crop_width(), s.crop_height());
  check_goals(s);
  return s;
}

Camera camera_of(const Scene& scene, const RenderSettings& settings) {
  Camera camera = scene.camera;
  camera.width = settings.size.width;
  camera.height = settings.size.height;
  return camera;
}

std::vector<Bsdf> bsdfs_of(const Scene& scene, const RenderSettings& settings) {
  std::vector<Bsdf> bsdfs = scene.bsdfs;
  if (!settings.masking) return bsdfs;
  for (Bsdf& bsdf : bsdfs) {
    std::visit(
        [&](auto& b) {
          if constexpr (requires { b.options; }) b.options.masking = *settings.masking;
        },
        bsdf);
  }
  return bsdfs;
}

RenderRecord record_of(const RenderSettings& settings) {
  RenderRecord r;
  r.version = FACET_VERSION;
  r.integrator = settings.integrator.type.name;
  r.sampler = name_of(settings.sampler);
  if (settings.sampler == Sampler::zsobol) r.planned = settings.planned;
  r.sampling = settings.sampling;
  r.samples.add(settings.samples);
  r.division = settings.division;
  r.adaptive = settings.adaptive;
  r.seed = settings.seed;
  r.max_depth = settings.integrator.interaction_limit();
  r.heuristic = settings.integrator.heuristic;
  r.emitter_selection = settings.integrator.emitter_selection;
  r.area_sampling = settings.integrator.area_sampling;
  r.environment_sampling = settings.integrator.environment_sampling;
  r.emitter_candidates = settings.integrator.emitter_candidates;
  r.masking = settings.masking;
  return r;
}

RenderRecord record_of(const Scene& scene, const RenderSettings& settings) {
  RenderRecord r = record_of(settings);
  r.scene = scene.file.string();
  r.filter = describe(scene.camera.filter);
  r.fingerprint = fingerprint(scene);
  return r;
}

}  // namespace facet
