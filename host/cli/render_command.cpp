// facet render: from a scene file to images.
#include <facet/checkpoint.h>
#include <unistd.h>

#include <filesystem>
#include <future>
#include <memory>
#include <random>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/render_options.h"
#include "cli/render_report.h"
#include "convergence/error_estimate.h"
#include "core/memory.h"
#include "core/print.h"
#include "core/text_file.h"
#include "door/open_backend.h"
#include "door/warnings.h"
#include "image/film.h"
#include "parts/checkpoint.h"
#include "parts/part.h"

namespace facet::cli {

namespace {

/// What a film of that size could be, as far as its handling takes time.
Film noise_film(int width, int height, bool with_squares) {
  Film film = make_film(width, height, {0, 0, width, height}, with_squares);
  std::mt19937 random(1);
  for (PixelSums& pixel : film.pixels) {
    for (int k = 0; k < 2; ++k) {
      const auto value = [&] { return static_cast<double>(random()) * 0x1p-32; };
      pixel.add({value(), value(), value()});
    }
  }
  return film;
}

/// One render, from options to files.
class RenderJob {
 public:
  explicit RenderJob(const RenderOptions& options) : options_(options) {
    outcome_.files = output_files(options);
  }

  ExitCode run() {
    check_checkpoint();
    check_outputs(outcome_.files, {options_.json, options_.checkpoint.value_or("")});
    // Drivers take longer to load than most scenes; what is wrong with the scene is said first.
    auto opening =
        std::async(std::launch::async, [&] { return open_backend(options_.backend.options()); });
    load();
    set_deadline();
    const std::unique_ptr<Backend> backend = opening.get();
    render(*backend);
    const std::vector<std::string> messages = backend->validation_messages();
    for (const std::string& message : messages) say("validation: {}\n", message);
    for (const std::string& remark : backend->remarks()) say("warning: {}\n", remark);
    outcome_.interrupted = was_interrupted();
    write();
    remove_checkpoint();
    report();
    print_failings(outcome_.statistics);
    warn_about_goals(outcome_);
    warn_about_heavy_tails(outcome_.heavy_tails);
    if (!lost_checkpoint_.empty()) throw InputError(lost_checkpoint_);
    if (outcome_.interrupted) return ExitCode::interrupted;
    return messages.empty() && outcome_.statistics.bound_hits == 0 ? ExitCode::done
                                                                   : ExitCode::check_failed;
  }

 private:
  /// What another render has come to is not written over.
  void check_checkpoint() const {
    if (!options_.checkpoint) return;
    const std::string& file = *options_.checkpoint;
    if (!options_.backend.is_reference() && !shared_devices(options_.backend.device).empty())
      throw InputError("--checkpoint: renders that several devices share are not saved midway");
    if (!is_exr(file)) throw InputError(fmt::format("{}: a checkpoint is an .exr", file));
    std::error_code unknown;
    if (std::filesystem::is_other(file, unknown))
      throw InputError(fmt::format("{}: a checkpoint is a file", file));
    if (!options_.resume && std::filesystem::exists(file, unknown))
      throw InputError(fmt::format(
          "{}: is there already: --resume continues it; remove it to begin anew", file));
  }

  void load() {
    const double start = seconds_since_start();
    Diagnostics diagnostics(options_.reading);
    scene_ = std::make_shared<const Scene>(
        read_scene(options_.scene, diagnostics, overridden_by(options_)));
    std::vector<std::string> outputs = outcome_.files;
    outputs.push_back(options_.json);
    outputs.push_back(options_.checkpoint.value_or(""));
    check_no_input_is_written(outputs, diagnostics.inputs());
    catch_interrupts();
    request_ = make_request(options_);
    request_.variance = wants_variance(options_.aovs);
    request_.estimate_error = estimates_error();
    if (options_.time) request_.deadline = Clock::now();
    settings_ = resolve(*scene_, request_);
    check_png_size(outcome_.files, settings_.crop_width(), settings_.crop_height());
    warn_about_render(*scene_, settings_, diagnostics, options_.backend.in_double());
    print_warnings(diagnostics);
    outcome_.scene = options_.scene;
    outcome_.triangles = scene_->triangle_count();
    outcome_.emitters = scene_->emitters.size();
    outcome_.error_goal = request_.error;
    outcome_.time_goal = options_.time;
    outcome_.is_pixel = request_.pixel.has_value();
    outcome_.load_seconds = seconds_since_start() - start;
  }

  /// Because the report and the progress bar tell the error; but a render that is continued goes on
  /// as it began, whoever looks on now.
  [[nodiscard]] bool estimates_error() const {
    std::error_code unknown;
    if (options_.resume && !wants_error(options_.aovs) &&
        std::filesystem::exists(*options_.checkpoint, unknown))
      return checkpoint_estimates_error(*options_.checkpoint);
    return !options_.json.empty() || wants_error(options_.aovs) ||
           (!options_.quiet && ::isatty(STDERR_FILENO) != 0);
  }

  /// How long it will take from the last sample to the end: tried with noise, which compresses
  /// worse than an image, of not too many rows.
  [[nodiscard]] double seconds_after_rendering() const {
    constexpr int most_pixels = 1 << 18;
    const int width = settings_.crop_width();
    const int height = settings_.crop_height();
    const int rows = std::clamp(most_pixels / width, 1, height);
    const double start = seconds_since_start();
    Film noise;
    // The device's films are read first: the image's, and that of samples beside it.
    for (int film = 0; film < (settings_.goal().has_trial() ? 2 : 1); ++film)
      noise = noise_film(width, rows, settings_.variance);
    RenderOutcome trial = outcome_;
    keep(noise, trial);
    try_writing(outcome_.files, trial.image, options_.writing);
    // Machines are not always as fast as just now.
    constexpr double reserve = 1.5;
    constexpr double ending_the_program = 0.06;
    return ending_the_program + reserve * (seconds_since_start() - start) * height / rows;
  }

  void set_deadline() {
    if (!options_.time) return;
    const double left = *options_.time - seconds_since_start() - seconds_after_rendering();
    request_.deadline = Clock::now() + duration_of(left);
  }

  void render(Backend& backend) {
    const Activity activity("rendering " + options_.scene);
    const std::unique_ptr<Rendering> rendering = backend.start(scene_, request_);
    Progress progress(options_.quiet,
                      request_.estimate_error
                          ? [&] { return estimate_error(rendering->film()).relative(); }
                          : std::function<double()>{});
    const ProgressCallback tell = [&](double done, const RenderStatistics& statistics) {
      progress.update(done, statistics);
      return !was_interrupted();
    };
    if (options_.checkpoint) {
      run_with_checkpoints(*rendering, tell);
    } else {
      rendering->run(tell);
    }
    progress.finish();
    outcome_.statistics = rendering->statistics();
    keep(rendering->film(), outcome_);
  }

  void run_with_checkpoints(Rendering& rendering, const ProgressCallback& tell) {
    const std::string& file = *options_.checkpoint;
    if (options_.resume) {
      const bool continued = resume(rendering, file);
      if (!options_.quiet)
        say("{}: {}\n", file, continued ? "continued" : "no such file yet, so it starts anew");
    }
    try {
      outcome_.checkpoints = facet::run_with_checkpoints(
          rendering,
          {file, options_.checkpoint_every,
           [](const std::string& message) { say("warning: {}; the render goes on\n", message); }},
          tell);
    } catch (const InputError& error) {
      // The images are written first.
      lost_checkpoint_ = error.what();
    }
  }

  void remove_checkpoint() const {
    if (!options_.checkpoint || outcome_.interrupted) return;
    std::error_code error;
    std::filesystem::remove(*options_.checkpoint, error);
    if (error)
      say("warning: {}: the render is complete, but its checkpoint could not be removed: {}\n",
          *options_.checkpoint, error.message());
  }

  void keep(Film film, RenderOutcome& outcome) const {
    outcome.record = film.record;
    outcome.error = estimate_error(film);
    outcome.heavy_tails = find_heavy_tails(film);
    const bool with_error = wants_error(options_.aovs);
    const ColorPlane errors = with_error ? standard_errors(film) : ColorPlane();
    const bool with_variance = wants_variance(options_.aovs);
    // What a part holds does not depend on who looked on.
    film.has_squares = with_variance;
    outcome.image =
        settings_.is_part ? make_part(film, with_variance) : develop(film, with_variance);
    if (with_error) outcome.image = with_errors(outcome.image, errors);
  }

  void write() {
    const double start = seconds_since_start();
    outcome_.files = write_images(outcome_.files, outcome_.image, options_.writing);
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
  RenderSettings settings_;
  RenderOutcome outcome_;
  std::string lost_checkpoint_;  ///< why there is none of a render that was interrupted
};

}  // namespace

void add_render_command(CommandLine& line) {
  const auto options = std::make_shared<RenderOptions>();
  Command command = line.add("render", "Render a scene");
  add_render_options(command, *options);
  command.action([options] { return RenderJob(*options).run(); });
}

}  // namespace facet::cli
