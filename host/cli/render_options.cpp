#include "cli/render_options.h"

#include <algorithm>
#include <filesystem>

#include "cli/backend_options.h"
#include "cli/outputs.h"
#include "core/text.h"
#include "scene/reader.h"

namespace facet::cli {

namespace {

/// Exactly `count` integers of at least 0, separated by a character.
std::vector<long long> parse_integers(const std::string& text, char separator, std::size_t count,
                                      const std::string& option, const std::string& form) {
  std::vector<long long> numbers;
  std::string_view rest = text;
  while (true) {
    const std::size_t end = std::min(rest.find(separator), rest.size());
    const auto number = parse_integer(rest.substr(0, end));
    if (!number || *number < 0) break;
    numbers.push_back(*number);
    if (end == rest.size()) {
      if (numbers.size() == count) return numbers;
      break;
    }
    rest.remove_prefix(end + 1);
  }
  throw InputError(fmt::format("{} \"{}\": {} expected", option, text, form));
}

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const IntegratorType& type : integrator_types()) names.emplace_back(type.name);
  return names;
}

Sampler parse_sampler(const std::string& name) {
  if (const auto sampler = find_sampler(name)) return *sampler;
  const std::vector<std::string> names(sampler_names.begin(), sampler_names.end());
  throw InputError(fmt::format("--sampler \"{}\": unknown{}; there are: {}", name, did_you_mean(name, names),
                               fmt::join(names, ", ")));
}

Crop parse_crop(const RenderOptions& options, const Camera& camera) {
  if (options.crop && options.pixel) throw InputError("--crop and --pixel exclude each other");
  std::vector<long long> v{0, 0, camera.width, camera.height};
  if (options.crop) v = parse_integers(*options.crop, ',', 4, "--crop", "X0,Y0,X1,Y1");
  if (options.pixel) {
    v = parse_integers(*options.pixel, ',', 2, "--pixel", "X,Y");
    v.push_back(v[0] + 1);
    v.push_back(v[1] + 1);
  }
  if (v[0] >= v[2] || v[1] >= v[3] || v[2] > camera.width || v[3] > camera.height) {
    throw InputError(fmt::format("{} lies outside the image of {}x{} pixels or is empty",
                                 options.pixel ? "--pixel " + *options.pixel : "--crop " + *options.crop,
                                 camera.width, camera.height));
  }
  return {static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2]), static_cast<int>(v[3])};
}

/// Options that go with one backend only.
void check_backend(const RenderOptions& o) {
  check_backend_options(o.backend, o.precision, o.device, o.validate);
  if (o.backend != "reference" && o.sampling == "uniform")
    throw InputError("--sampling uniform belongs to --backend reference");
}

void set_masking(Scene& scene, bsdf::Masking masking) {
  for (Bsdf& bsdf : scene.bsdfs) {
    std::visit(
        [masking](auto& b) {
          if constexpr (requires { b.options; }) b.options.masking = masking;
        },
        bsdf);
  }
}

LobeSampling lobe_sampling(const std::string& name) {
  if (name == "uniform") return LobeSampling::uniform;
  return name == "ndf" ? LobeSampling::ndf : LobeSampling::visible;
}

}  // namespace

void add_scene_options(CLI::App& command, RenderOptions& o) {
  command.add_option("scene", o.scene, "Scene file (XML)")->required();
  command.add_option("--spp", o.spp, "Samples per pixel")->check(CLI::Range(1, 1 << 30));
  command.add_option("--integrator", o.integrator, "Integrator, by its name in the scene language");
  command.add_option("--sampler", o.sampler,
                     "Sampler, by its name in the scene language: independent or sobol");
  command.add_option("--max-depth", o.max_depth, "Surface interactions of a path, -1: unlimited")
      ->check(CLI::Range(-1, 1 << 30));
  command.add_option("--resolution", o.resolution, "Size of the image, WxH");
  command.add_option("--crop", o.crop, "Render only the pixels X0,Y0,X1,Y1 (X1 and Y1 excluded)");
  command.add_option("--pixel", o.pixel, "Compute only the pixel X,Y; render prints its value");
  command.add_option("--seed", o.seed, "Seed of the random numbers");
  command.add_option("--sample-range", o.sample_range,
                     "Render only the samples A:B of each pixel (B excluded)");
  command.add_option("--heuristic", o.heuristic, "MIS weights")->check(CLI::IsMember({"balance", "power"}));
  command
      .add_option("--emitter-selection", o.emitter_selection, "How the emitter of a light sample is chosen")
      ->check(CLI::IsMember({"uniform", "power"}));
  command.add_option("--masking", o.masking, "Masking function of Beckmann's distribution")
      ->check(CLI::IsMember({"rational", "exact"}));
  command.add_option("--json", o.json, "Write a report to this file, - for standard output");
  command.add_flag("--quiet", o.quiet, "Nothing but errors and warnings on standard error");
  command.add_flag("--strict", o.strict, "Warnings are errors");
}

void add_render_options(CLI::App& command, RenderOptions& o) {
  add_scene_options(command, o);
  command.get_option("--sample-range")
      ->description(
          "Render only the samples A:B of each pixel (B excluded); their EXR is a part, which facet "
          "merge joins with others");
  command
      .add_option("-o,--output", o.outputs,
                  "Image to write, .exr or .png; may be repeated. Default: SCENE.exr and SCENE.png here")
      ->allow_extra_args(false);
  add_backend_options(command, o.backend, o.precision, o.device, o.validate);
  command
      .add_option("--sampling", o.sampling,
                  "Half vectors of rough lobes: from the ndf, or visible from the viewer; uniform: the "
                  "reference ignores what BSDFs know of sampling and takes the uniform hemisphere (of what "
                  "transmits, the sphere)")
      ->check(CLI::IsMember({"ndf", "visible", "uniform"}))
      ->capture_default_str();
  add_aov_option(command, o.aovs);
  add_exposure_option(command, o.exposure);
}

Overridden overridden_by(const RenderOptions& o) { return {o.integrator.has_value(), o.sampler.has_value()}; }

void apply_to_scene(const RenderOptions& o, Scene& scene) {
  if (o.integrator) {
    const auto type = find_integrator_type(*o.integrator);
    if (!type) {
      throw InputError(fmt::format("--integrator \"{}\": unknown{}; there are: {}", *o.integrator,
                                   did_you_mean(*o.integrator, integrator_names()),
                                   fmt::join(integrator_names(), ", ")));
    }
    scene.integrator.type = *type;
  }
  if (scene.integrator.type.name.empty()) {
    throw InputError(fmt::format("{}: the scene has no integrator; name one with --integrator", o.scene));
  }
  check_backend(o);
  if (o.sampler) scene.sampler = parse_sampler(*o.sampler);
  if (o.max_depth) scene.integrator.max_depth = *o.max_depth;
  if (!o.heuristic.empty())
    scene.integrator.heuristic = o.heuristic == "power" ? Heuristic::power : Heuristic::balance;
  if (!o.emitter_selection.empty()) {
    scene.emitter_selection =
        o.emitter_selection == "uniform" ? EmitterSelection::uniform : EmitterSelection::power;
  }
  if (!o.masking.empty())
    set_masking(scene, o.masking == "exact" ? bsdf::Masking::exact : bsdf::Masking::rational);
  if (o.resolution) {
    const auto size = parse_integers(*o.resolution, 'x', 2, "--resolution", "WxH");
    check_image_size(size[0], size[1]);
    scene.camera.width = static_cast<int>(size[0]);
    scene.camera.height = static_cast<int>(size[1]);
  }
  if (o.spp) scene.sample_count = *o.spp;
  if (o.seed) scene.seed = *o.seed;
}

RenderSettings make_settings(const RenderOptions& o, const Scene& scene) {
  RenderSettings settings;
  settings.crop = parse_crop(o, scene.camera);
  settings.end_sample = static_cast<std::uint32_t>(scene.sample_count);
  if (o.sample_range) {
    const auto range = parse_integers(*o.sample_range, ':', 2, "--sample-range", "A:B");
    if (range[0] >= range[1] || range[1] > (1LL << 30))
      throw InputError(fmt::format("--sample-range {}: empty or too large", *o.sample_range));
    settings.first_sample = static_cast<std::uint32_t>(range[0]);
    settings.end_sample = static_cast<std::uint32_t>(range[1]);
  }
  settings.seed = scene.seed;
  settings.sampling = lobe_sampling(o.sampling);
  return settings;
}

std::vector<std::string> output_files(const RenderOptions& o) {
  if (o.scene.empty()) throw InputError("render: the scene's name is empty");
  std::vector<std::string> files = o.outputs;
  if (files.empty() && !o.pixel) {
    const std::string stem = std::filesystem::path(o.scene).stem().string();
    files = {stem + ".exr", stem + ".png"};
  }
  return files;
}

}  // namespace facet::cli
