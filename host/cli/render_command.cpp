// facet render: from a scene file to images.
#include <unistd.h>

#include <future>
#include <memory>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/render_options.h"
#include "cli/render_report.h"
#include "core/print.h"
#include "core/text_file.h"
#include "door/warnings.h"
#include "image/film.h"
#include "parts/part.h"

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
    // Drivers take longer to load than most scenes; what is wrong with the scene is said first.
    auto opening =
        std::async(std::launch::async, [&] { return open_backend(options_.backend.options()); });
    load();
    const std::unique_ptr<Backend> backend = opening.get();
    render(*backend);
    const std::vector<std::string> messages = backend->validation_messages();
    for (const std::string& message : messages) say("validation: {}\n", message);
    outcome_.interrupted = was_interrupted();
    write();
    report();
    print_failings(outcome_.statistics);
    warn_about_heavy_tails(outcome_.heavy_tails);
    if (outcome_.interrupted) return ExitCode::interrupted;
    return messages.empty() && outcome_.statistics.bound_hits == 0 ? ExitCode::done
                                                                   : ExitCode::check_failed;
  }

 private:
  void load() {
    const double start = seconds_since_start();
    Diagnostics diagnostics(options_.strict);
    scene_ = std::make_shared<const Scene>(
        read_scene(options_.scene, diagnostics, overridden_by(options_)));
    std::vector<std::string> outputs = outcome_.files;
    outputs.push_back(options_.json);
    check_no_input_is_written(outputs, diagnostics.inputs());
    catch_interrupts();
    request_ = make_request(options_);
    // Sums of squares serve the variance channels and the error estimates of the report and the
    // progress bar.
    request_.variance = wants_variance(options_.aovs) || !options_.json.empty() ||
                        (!options_.quiet && ::isatty(STDERR_FILENO) != 0);
    const RenderSettings settings = resolve(*scene_, request_);
    check_png_size(outcome_.files, settings.crop_width(), settings.crop_height());
    warn_about_render(*scene_, settings, diagnostics, options_.backend.in_double());
    print_warnings(diagnostics);
    outcome_.scene = options_.scene;
    outcome_.triangles = scene_->triangle_count();
    outcome_.emitters = scene_->emitters.size();
    outcome_.is_pixel = request_.pixel.has_value();
    outcome_.load_seconds = seconds_since_start() - start;
  }

  void render(Backend& backend) {
    const std::unique_ptr<Rendering> rendering = backend.start(scene_, request_);
    Progress progress(options_.quiet,
                      request_.variance
                          ? [&] { return std::sqrt(estimate_relmse(rendering->film())); }
                          : std::function<double()>{});
    rendering->run([&](double done, const RenderStatistics& statistics) {
      progress.update(done, statistics);
      return !was_interrupted();
    });
    progress.finish();
    outcome_.statistics = rendering->statistics();
    keep(rendering->film());
  }

  void keep(Film film) {
    outcome_.record = film.record;
    outcome_.relmse = estimate_relmse(film);
    outcome_.heavy_tails = find_heavy_tails(film);
    const bool with_variance = wants_variance(options_.aovs);
    // What a part holds does not depend on who looked on.
    film.has_squares = with_variance;
    outcome_.image =
        request_.sample_range ? make_part(film, with_variance) : develop(film, with_variance);
  }

  void write() {
    const double start = seconds_since_start();
    outcome_.files = write_images(outcome_.files, outcome_.image, options_.exposure);
    outcome_.write_seconds = seconds_since_start() - start;
  }

  void report() const {
    if (!options_.json.empty()) write_text(options_.json, make_json_report(outcome_) + '\n');
    const Image& image = outcome_.image;
    if (outcome_.is_pixel && options_.json != "-") {
      put("pixel {}: {:.9g} {:.9g} {:.9g}\n", *options_.pixel, image.at(0, 0, 0), image.at(0, 0, 1),
          image.at(0, 0, 2));
    }
    if (!options_.quiet) print_summary(outcome_);
  }

  const RenderOptions& options_;
  ScenePtr scene_;
  RenderRequest request_;
  RenderOutcome outcome_;
};

}  // namespace

void add_render_command(CommandLine& line) {
  const auto options = std::make_shared<RenderOptions>();
  Command command = line.add("render", "Render a scene");
  add_render_options(command, *options);
  command.action([options] { return RenderJob(*options).run(); });
}

}  // namespace facet::cli
