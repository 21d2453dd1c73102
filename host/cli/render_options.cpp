#include "cli/render_options.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include "cli/array_jobs.h"
#include "cli/outputs.h"
#include "cli/reading_options.h"
#include "core/text.h"
#include "core/words.h"
#include "image/division.h"

namespace facet::cli {

namespace {

/// Exactly `count` integers from 0 to 2^31 - 1, separated by a character.
template <std::size_t count>
std::array<int, count> parse_integers(const std::string& text, char separator, const char* option,
                                      const char* form) {
  std::array<int, count> numbers{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t end = i + 1 < count ? rest.find(separator) : rest.size();
    const auto number =
        end == std::string_view::npos ? std::nullopt : parse_integer(rest.substr(0, end));
    if (!number || *number < 0)
      throw InputError(fmt::format("{} \"{}\": {} expected", option, text, form));
    if (*number > std::numeric_limits<int>::max())
      throw InputError(fmt::format("{} \"{}\": {} is too large", option, text, *number));
    numbers[i] = static_cast<int>(*number);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return numbers;
}

/// SCENE.exr and SCENE.png, or the EXR of a share.
std::vector<std::string> default_files(const RenderOptions& o) {
  const std::string stem = std::filesystem::path(o.scene).stem().string();
  const RenderRequest request = make_request(o);
  if (request.part || request.tile) return {share_file(stem, request.part, request.tile)};
  return {stem + ".exr", stem + ".png"};
}

}  // namespace

void add_sampling_option(Command& command, LobeSampling& sampling, bool with_uniform) {
  std::string help = "Half vectors of rough lobes: from the ndf, or visible from the viewer";
  if (with_uniform)
    help +=
        "; uniform: the reference ignores what BSDFs know of sampling and takes the uniform "
        "hemisphere (of what transmits, the sphere)";
  command.word("--sampling", sampling, lobe_sampling_words, help, with_uniform ? 3 : 2);
}

void add_setting_options(Command& command, RenderOptions& o) {
  RenderRequest& r = o.request;
  command.argument("scene", o.scene, "Scene file (XML)");
  command.number("--spp", r.samples, 1, static_cast<int>(largest_sample_count),
                 "Samples per pixel; what this and the next options leave open, the scene says");
  command.text("--integrator", r.integrator, "Integrator, by its name in the scene language");
  command.text("--sampler", r.sampler,
               "Sampler, by its name in the scene language: independent, sobol or zsobol");
  command.number("--max-depth", r.max_depth, -1, 1 << 30,
                 "Most surface interactions of a path, -1: unlimited");
  command.text("--resolution", o.resolution, "Size of the image, WxH");
  command.text("--crop", o.crop, "Render only the pixels X0,Y0,X1,Y1 (X1 and Y1 excluded)");
  add_seed_option(command, r.seed);
  command.word("--heuristic", r.heuristic, heuristic_words, "MIS weights");
  command.word("--emitter-selection", r.emitter_selection, emitter_selection_words,
               "How the emitter of a light sample is chosen");
  command.word("--area-sampling", r.area_sampling, area_sampling_words,
               "How a point of an area emitter is sampled");
  command.word("--environment-sampling", r.environment_sampling, environment_sampling_words,
               "How an environment is sampled where BSDFs are sampled as well");
  command.number("--emitter-candidates", r.emitter_candidates, 1,
                 static_cast<int>(shared::LARGEST_CANDIDATES),
                 "Emitter samples of which one is taken, by what it would contribute unshadowed");
  command.word("--masking", r.masking, masking_words,
               "Masking function of Beckmann's distribution");
  add_report_options(command, o.json, o.quiet);
  add_reading_options(command, o.reading);
}

void add_scene_options(Command& command, RenderOptions& o) {
  add_setting_options(command, o);
  command.text("--pixel", o.pixel, "Compute only the pixel X,Y; render prints its value");
  command.text("--sample-range", o.sample_range,
               "Render only the samples A:B of each pixel (B excluded)");
}

void add_render_options(Command& command, RenderOptions& o) {
  add_scene_options(command, o);
  command.describe("--sample-range",
                   "Render only the samples A:B of each pixel (B excluded); their EXR is a part, "
                   "which facet merge joins with others");
  command.text(
      "--part", o.part,
      "Render only the share I/N of the samples, I from 1 on; or ENGINE or ENGINE/N, whose "
      "environment tells I: " +
          engine_names());
  command.text("--tile", o.tile,
               "Render only the share I/N of the rows of the image, I from 1 on; likewise");
  command.texts(
      "-o,--output", o.outputs,
      "Image to write, .exr or .png, or a folder for the default; may be repeated. "
      "Default: SCENE.exr and SCENE.png here; of a part or a tile an EXR with its number");
  add_backend_options(command, o.backend);
  command.text(
      "--error", o.error,
      "Render until the relative error of the image (root of relMSE) is at most this, 1% or "
      "0.01, with 95 % confidence; --spp is the most samples then");
  command.number("--time", o.time, 1e-3, 1e9,
                 "End within so many seconds, starting and writing included; --spp is the most "
                 "samples then");
  command.flag("--adaptive", o.request.adaptive,
               "Pixels get samples by their variance, --spp on average");
  command.text("--checkpoint", o.checkpoint,
               "Save the render to this .exr time and again, and at Ctrl-C, SIGTERM or "
               "SIGHUP; it is a part, "
               "which facet merge reads, and is removed once the images are written");
  command.number("--checkpoint-every", o.checkpoint_every, 0.01, 1e9,
                 "Seconds between checkpoints; more where one takes long");
  command.flag("--resume", o.resume,
               "Continue from --checkpoint, with the bits of an uninterrupted render; start anew "
               "where there is no such file");
  add_sampling_option(command, o.request.sampling, true);
  add_aov_option(command, o.aovs, true);
  add_writing_options(command, o.writing);
}

RenderRequest make_request(const RenderOptions& o) {
  RenderRequest request = o.request;
  if (o.resolution) {
    const auto v = parse_integers<2>(*o.resolution, 'x', "--resolution", "WxH");
    request.size = {v[0], v[1]};
  }
  if (o.crop) {
    const auto v = parse_integers<4>(*o.crop, ',', "--crop", "X0,Y0,X1,Y1");
    request.crop = {v[0], v[1], v[2], v[3]};
  }
  if (o.pixel) request.pixel = parse_integers<2>(*o.pixel, ',', "--pixel", "X,Y");
  if (o.sample_range) {
    const auto v = parse_integers<2>(*o.sample_range, ':', "--sample-range", "A:B");
    request.sample_range = {static_cast<std::uint32_t>(v[0]), static_cast<std::uint32_t>(v[1])};
  }
  if (o.part) request.part = read_share(*o.part, "--part");
  if (o.tile) request.tile = read_share(*o.tile, "--tile");
  if (o.resume && !o.checkpoint)
    throw InputError("--resume: --checkpoint FILE.exr, from which to continue, is needed");
  if (o.error) request.error = parse_relative_error(*o.error, "--error");
  return request;
}

double parse_relative_error(const std::string& text, const char* option) {
  std::string_view number = text;
  const bool percent = number.ends_with('%');
  if (percent) number = trimmed(number.substr(0, number.size() - 1));
  const auto value = parse_real(number);
  // Whoever writes 5 hardly means five times the image.
  if (!value || !(*value > 0) || (!percent && *value >= 1))
    throw InputError(
        fmt::format("{} \"{}\": a relative error above 0 expected, as 1% or 0.01", option, text));
  return percent ? *value / 100 : *value;
}

Overridden overridden_by(const RenderOptions& o) {
  return {o.request.integrator.has_value(), o.request.sampler.has_value()};
}

std::vector<std::string> output_files(const RenderOptions& o) {
  if (o.scene.empty()) throw InputError("render: the scene's name is empty");
  if (o.outputs.empty()) return o.pixel ? std::vector<std::string>{} : default_files(o);
  std::vector<std::string> files;
  for (const std::string& output : o.outputs) {
    // What is named as an image is one, and an error where it is a folder.
    std::error_code unknown;
    const bool is_folder = !output.ends_with(".exr") && !output.ends_with(".png") &&
                           std::filesystem::is_directory(output, unknown);
    if (!output.ends_with('/') && !is_folder) {
      files.push_back(output);
      continue;
    }
    for (const std::string& name : default_files(o))
      files.push_back((std::filesystem::path(output) / name).string());
  }
  return files;
}

}  // namespace facet::cli
