// facet render: from a scene file to images.
#include <fmt/format.h>
#include <unistd.h>

#include <future>
#include <memory>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/render_report.h"
#include "cli/text_file.h"
#include "cli/warnings.h"
#include "core/print.h"
#include "image/part.h"
#include "reference/renderer.h"
#include "render/renderer.h"
#include "scene/reader.h"

namespace facet::cli {

namespace {

/// One render, from options to files.
class RenderJob {
 public:
  explicit RenderJob(const RenderOptions& options) : options_(options) {
    outcome_.files = output_files(options);
  }

  ExitCode run() {
    check_outputs(outcome_.files, {options_.json});
    const bool silent = options_.backend == "reference" ? render_reference() : render_on_device();
    outcome_.interrupted = was_interrupted();
    write();
    report();
    print_failings(outcome_.statistics);
    warn_about_heavy_tails(outcome_.heavy_tails);
    if (outcome_.interrupted) return ExitCode::interrupted;
    return silent && outcome_.statistics.bound_hits == 0 ? ExitCode::done : ExitCode::check_failed;
  }

 private:
  void load() {
    const double start = seconds_since_start();
    Diagnostics diagnostics(options_.strict);
    outcome_.scene = read_scene(options_.scene, diagnostics, overridden_by(options_));
    std::vector<std::string> outputs = outcome_.files;
    outputs.push_back(options_.json);
    check_no_input_is_written(outputs, diagnostics.inputs());
    catch_interrupts();
    apply_to_scene(options_, outcome_.scene);
    outcome_.settings = make_settings(options_, outcome_.scene);
    const Crop& crop = outcome_.settings.crop;
    check_png_size(outcome_.files, crop.x1 - crop.x0, crop.y1 - crop.y0);
    warn_about_scene(outcome_.scene, diagnostics, options_.precision == "double");
    print_warnings(diagnostics);
    // Sums of squares serve the variance channels and the error estimates of the report and the progress bar.
    outcome_.settings.variance = wants_variance(options_.aovs) || !options_.json.empty() ||
                                 (!options_.quiet && ::isatty(STDERR_FILENO) != 0);
    outcome_.load_seconds = seconds_since_start() - start;
  }

  /// Returns whether the validation layers, if on, had nothing to say.
  bool render_on_device() {
    // Drivers take longer to load than most scenes; what is wrong with the scene is said first.
    auto loading_drivers = std::async(
        std::launch::async, [&] { return std::make_unique<const gpu::Instance>(options_.validate); });
    load();
    const std::unique_ptr<const gpu::Instance> drivers = loading_drivers.get();
    const gpu::Instance& instance = *drivers;
    gpu::Device device(instance, instance.choose(options_.device));
    outcome_.device = device.info().name;
    outcome_.driver = device.info().driver;
    const PackedScene packed = pack_scene(outcome_.scene);
    outcome_.bvh_seconds = packed.bvh_seconds;
    const Features features = find_features(outcome_.scene, outcome_.settings);
    outcome_.features = features.names();
    {
      Renderer renderer(device, packed, features, outcome_.settings);
      Progress progress(options_.quiet,
                        outcome_.settings.variance
                            ? [&renderer] { return std::sqrt(estimate_relmse(renderer.film())); }
                            : std::function<double()>{});
      renderer.render(telling(progress));
      progress.finish();
      outcome_.statistics = renderer.statistics();
      keep(renderer.film());
    }
    for (const std::string& message : instance.validation().messages) say("validation: {}\n", message);
    return instance.validation().messages.empty();
  }

  bool render_reference() {
    load();
    const bool in_double = options_.precision == "double";
    outcome_.device = in_double ? "CPU reference in double" : "CPU reference in float";
    outcome_.driver = "none";
    Progress progress(options_.quiet, {});
    const auto render = in_double ? reference::render<double> : reference::render<float>;
    const Film film = render(outcome_.scene, outcome_.settings, telling(progress), outcome_.statistics);
    progress.finish();
    keep(film);
    return true;
  }

  static ProgressCallback telling(Progress& progress) {
    return [&progress](double done, const RenderStatistics& statistics) {
      progress.update(done, statistics);
      return !was_interrupted();
    };
  }

  void keep(Film film) {
    outcome_.relmse = estimate_relmse(film);
    outcome_.heavy_tails = find_heavy_tails(film);
    const bool with_variance = wants_variance(options_.aovs);
    // What a part holds does not depend on who looked on.
    film.has_squares = with_variance;
    outcome_.image = options_.sample_range ? make_part(film, with_variance) : develop(film, with_variance);
  }

  void write() {
    const double start = seconds_since_start();
    auto metadata = make_metadata(options_, outcome_);
    metadata.insert(metadata.end(), outcome_.image.metadata.begin(), outcome_.image.metadata.end());
    outcome_.image.metadata = std::move(metadata);
    outcome_.files = write_images(outcome_.files, outcome_.image, options_.exposure);
    outcome_.write_seconds = seconds_since_start() - start;
  }

  void report() const {
    if (!options_.json.empty()) write_text(options_.json, make_json_report(options_, outcome_) + '\n');
    const Image& image = outcome_.image;
    if (options_.pixel && options_.json != "-") {
      put("pixel {}: {:.9g} {:.9g} {:.9g}\n", *options_.pixel, image.at(0, 0, 0), image.at(0, 0, 1),
          image.at(0, 0, 2));
    }
    if (!options_.quiet) print_summary(options_, outcome_);
  }

  const RenderOptions& options_;
  RenderOutcome outcome_;
};

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Render a scene");
  add_render_options(*command, *options);
  command->callback([options, &action] { action = [options] { return RenderJob(*options).run(); }; });
}

}  // namespace facet::cli
