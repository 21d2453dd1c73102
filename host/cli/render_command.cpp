// facet render: from a scene file to images.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/render_options.h"
#include "cli/warnings.h"
#include "core/text.h"
#include "image/atomic_file.h"
#include "image/files.h"
#include "render/renderer.h"
#include "scene/reader.h"
#include "version.h"

namespace facet::cli {

namespace {

/// One render, from options to files.
class RenderJob {
 public:
  explicit RenderJob(const RenderOptions& options) : options_(options), files_(output_files(options)) {}

  ExitCode run() {
    catch_interrupts();
    check_outputs();
    load();
    const gpu::Instance instance(options_.validate);
    gpu::Device device(instance, instance.choose(options_.device));
    device_ = device.info();
    const PackedScene packed = pack_scene(scene_);
    bvh_seconds_ = packed.bvh_seconds;
    const Features features = find_features(scene_, settings_);
    feature_names_ = features.names();
    render(device, packed, features);
    write();
    report();
    return exit_code(instance.validation());
  }

 private:
  void check_outputs() const {
    std::set<std::string> names;
    std::vector<std::string> all = files_;
    if (!options_.json.empty() && options_.json != "-") all.push_back(options_.json);
    for (const std::string& file : all) {
      check_writable(file);
      if (!names.insert(std::filesystem::weakly_canonical(file).string()).second) {
        throw InputError(fmt::format("{}: is to be written twice", file));
      }
    }
  }

  void load() {
    const double start = seconds_since_start();
    Diagnostics diagnostics(options_.strict);
    scene_ = read_scene(options_.scene, diagnostics);
    apply_to_scene(options_, scene_);
    settings_ = make_settings(options_, scene_);
    check_png_size();
    warn_about_scene(scene_, diagnostics);
    print_warnings(diagnostics);
    // Sums of squares serve the variance channels and the error estimates of the report and the progress bar.
    settings_.variance = options_.wants_variance_channels() || !options_.json.empty() ||
                         (!options_.quiet && ::isatty(STDERR_FILENO) != 0);
    load_seconds_ = seconds_since_start() - start;
  }

  void check_png_size() const {
    constexpr int largest_png_side = 1000000;
    const bool too_large = std::max(settings_.crop.x1 - settings_.crop.x0,
                                    settings_.crop.y1 - settings_.crop.y0) > largest_png_side;
    for (const std::string& file : files_) {
      if (too_large && std::filesystem::path(file).extension() == ".png") {
        throw InputError(
            fmt::format("{}: a PNG's sides are at most {} pixels; write an EXR", file, largest_png_side));
      }
    }
  }

  void render(gpu::Device& device, const PackedScene& packed, const Features& features) {
    Renderer renderer(device, packed, features, settings_);
    Progress progress(options_.quiet,
                      settings_.variance ? [&renderer] { return std::sqrt(estimate_relmse(renderer.film())); }
                                         : std::function<double()>{});
    renderer.render([&](double done, const RenderStatistics& statistics) {
      progress.update(done, statistics);
      return !was_interrupted();
    });
    progress.finish();
    statistics_ = renderer.statistics();
    const Film film = renderer.film();
    relmse_ = estimate_relmse(film);
    image_ = develop(film, options_.wants_variance_channels());
  }

  void write() {
    const double start = seconds_since_start();
    add_metadata();
    for (const std::string& file : files_) {
      if (std::filesystem::path(file).extension() == ".exr") {
        write_exr(file, image_);
      } else {
        write_png(file, image_, options_.exposure);
      }
    }
    write_seconds_ = seconds_since_start() - start;
  }

  void add_metadata() {
    image_.metadata = {
        {"facet.version", FACET_VERSION},
        {"facet.scene", scene_.file.filename().string()},
        {"facet.integrator", std::string(scene_.integrator.type.name)},
        {"facet.sampler", "independent"},
        {"facet.sampling", options_.sampling},
        {"facet.samples", fmt::format("{}:{}", settings_.first_sample, settings_.end_sample)},
        {"facet.spp", fmt::format("{}", settings_.end_sample - settings_.first_sample)},
        {"facet.seed", fmt::format("{}", settings_.seed)},
        {"facet.maxDepth", fmt::format("{}", scene_.integrator.interaction_limit())},
        {"facet.device", device_.name},
        {"facet.driver", device_.driver},
        {"facet.seconds", fmt::format("{:.3f}", statistics_.render_seconds)},
        {"facet.complete", was_interrupted() ? "no: interrupted" : "yes"},
    };
  }

  [[nodiscard]] double per_second(std::uint64_t count) const {
    return statistics_.render_seconds > 0 ? static_cast<double>(count) / statistics_.render_seconds : 0;
  }

  [[nodiscard]] nlohmann::ordered_json make_json() const {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const RenderStatistics& s = statistics_;
    return {
        {"scene", options_.scene},
        {"device", device_.name},
        {"driver", device_.driver},
        {"backend", "vulkan"},
        {"integrator", scene_.integrator.type.name},
        {"sampler", "independent"},
        {"width", image_.width()},
        {"height", image_.height()},
        {"spp", settings_.end_sample - settings_.first_sample},
        {"seed", settings_.seed},
        {"triangles", scene_.triangle_count()},
        {"emitters", scene_.emitters.size()},
        {"features", feature_names_},
        {"seconds",
         {{"load", load_seconds_},
          {"bvh", bvh_seconds_},
          {"compile", s.compile_seconds},
          {"render", s.render_seconds},
          {"write", write_seconds_},
          {"total", seconds_since_start()}}},
        {"rays", {{"closest", s.closest_rays}, {"any", s.any_rays}}},
        {"samples_per_second", per_second(s.samples)},
        {"rays_per_second", per_second(s.closest_rays + s.any_rays)},
        {"error_estimate", {{"relmse", relmse_}, {"relative", std::sqrt(relmse_)}}},
        {"bad_samples", s.bad_samples},
        {"bound_hits", s.bound_hits},
        {"memory",
         {{"device_bytes", s.device_bytes},
          {"host_peak_bytes", static_cast<std::uint64_t>(usage.ru_maxrss) * 1024}}},
        {"output", files_},
    };
  }

  /// A path that is no UTF-8 is shown as well as it can be.
  [[nodiscard]] std::string json_text() const {
    nlohmann::ordered_json json = make_json();
    if (options_.pixel) json["pixel"] = {image_.at(0, 0, 0), image_.at(0, 0, 1), image_.at(0, 0, 2)};
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  }

  void write_json() const {
    AtomicFile file(options_.json);
    std::ofstream out(file.temporary());
    out << json_text() << '\n';
    out.close();
    if (!out) throw InputError(fmt::format("{}: cannot write", options_.json));
    file.commit();
  }

  void report() const {
    if (options_.json == "-") fmt::print("{}\n", json_text());
    if (!options_.json.empty() && options_.json != "-") write_json();
    if (options_.pixel && options_.json != "-") {
      fmt::print("pixel {}: {:.9g} {:.9g} {:.9g}\n", *options_.pixel, image_.at(0, 0, 0), image_.at(0, 0, 1),
                 image_.at(0, 0, 2));
    }
    if (options_.quiet) return;
    const RenderStatistics& s = statistics_;
    fmt::print(stderr, "{}: {}, {} triangles, {}x{} pixels, {} samples each{}\n", options_.scene,
               scene_.integrator.type.name, scene_.triangle_count(), image_.width(), image_.height(),
               settings_.end_sample - settings_.first_sample, was_interrupted() ? " (interrupted)" : "");
    fmt::print(stderr, "{:.2f} s on {}: {}samples/s, {}rays/s; {:.2f} s in all\n", s.render_seconds,
               device_.name, with_unit_prefix(per_second(s.samples)) + " ",
               with_unit_prefix(per_second(s.closest_rays + s.any_rays)) + " ", seconds_since_start());
    if (!files_.empty()) fmt::print(stderr, "wrote {}\n", fmt::join(files_, " and "));
  }

  /// Warns about what must not happen, and says how the render went.
  [[nodiscard]] ExitCode exit_code(const gpu::ValidationLog& validation) const {
    for (const std::string& message : validation.messages) fmt::print(stderr, "validation: {}\n", message);
    if (statistics_.bad_samples > 0) {
      fmt::print(stderr, "warning: {} samples were dropped: NaN, infinite or negative\n",
                 statistics_.bad_samples);
    }
    if (statistics_.bound_hits > 0) {
      fmt::print(stderr,
                 "warning: {} rays were stopped by the safety bound of traversal; the image is wrong there\n",
                 statistics_.bound_hits);
    }
    if (was_interrupted()) return ExitCode::interrupted;
    return validation.messages.empty() && statistics_.bound_hits == 0 ? ExitCode::done
                                                                      : ExitCode::check_failed;
  }

  const RenderOptions& options_;
  std::vector<std::string> files_;
  Scene scene_;
  RenderSettings settings_;
  gpu::DeviceInfo device_;
  std::vector<std::string> feature_names_;
  RenderStatistics statistics_;
  Image image_;
  double relmse_ = 0;
  double load_seconds_ = 0;
  double bvh_seconds_ = 0;
  double write_seconds_ = 0;
};

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Render a scene");
  add_render_options(*command, *options);
  command->callback([options, &action] { action = [options] { return RenderJob(*options).run(); }; });
}

}  // namespace facet::cli
