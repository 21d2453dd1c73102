// facet farm-plan: into how many parts to divide a render, what they take, and the script that
// submits them, from a short measurement.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/farm_plan_trial.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/render_options.h"
#include "convergence/error_estimate.h"
#include "core/memory.h"
#include "core/print.h"
#include "core/text.h"
#include "core/text_file.h"
#include "door/open_backend.h"
#include "door/warnings.h"
#include "image/division.h"
#include "image/record.h"
#include "image/rerun.h"
#include "tradeoff/farm_plan.h"

namespace facet::cli {

namespace {

struct FarmPlanOptions {
  RenderOptions render;
  std::optional<std::uint32_t> nodes;
  double measure = 10;
  double longest_part = 600;
  std::string script;
};

class FarmPlanJob {
 public:
  explicit FarmPlanJob(const FarmPlanOptions& options) : options_(options) {}

  ExitCode run() {
    const RenderOptions& o = options_.render;
    check_outputs({}, {o.json, options_.script});
    wish();
    load();
    catch_interrupts();
    measure();
    if (was_interrupted()) {
      say("interrupted before there was anything to tell\n");
      return ExitCode::interrupted;
    }
    plan_ = tradeoff::plan_farm(measured_, wish_);
    constexpr std::uint32_t few_samples = 4;
    if (measured_.samples < std::min(few_samples, plan_.samples))
      say("warning: only {} of the samples could be measured; a longer --measure is surer\n",
          measured_.samples);
    if (!options_.script.empty()) write_script();
    if (!o.json.empty()) write_text(o.json, json_text() + '\n');
    if (o.json != "-") tell();
    return ExitCode::done;
  }

 private:
  void wish() {
    const RenderOptions& o = options_.render;
    request_ = make_request(o);
    if (!options_.nodes)
      throw InputError("farm-plan: --nodes, how many nodes like this one there are, is needed");
    if (!o.backend.is_reference() && !shared_devices(o.backend.device).empty())
      throw InputError(
          "farm-plan: what several devices share is not measured: --device one of them");
    wish_.nodes = *options_.nodes;
    wish_.longest_part = options_.longest_part;
    wish_.error = request_.error;
    if (request_.error && request_.samples)
      throw InputError(
          "farm-plan: --spp says how many samples there are, --error that it is to be "
          "found out: one of them");
  }

  void load() {
    const double start = seconds_since_start();
    const RenderOptions& o = options_.render;
    Diagnostics diagnostics(o.reading);
    scene_ = std::make_shared<const Scene>(read_scene(o.scene, diagnostics, overridden_by(o)));
    check_no_input_is_written({o.json, options_.script}, diagnostics.inputs());
    const RenderSettings settings = resolve(*scene_, request_);
    if (!wish_.error) wish_.samples = settings.samples.end;
    warn_about_render(*scene_, settings, diagnostics, o.backend.in_double());
    print_warnings(diagnostics);
    measured_.start_seconds = seconds_since_start() - start;
  }

  void measure() {
    const Activity activity("measuring " + options_.render.scene);
    const double start = seconds_since_start();
    const std::unique_ptr<Backend> backend = open_backend(options_.render.backend.options());
    RenderRequest request = request_;
    request.error.reset();
    request.estimate_error = true;
    request.deadline = Clock::now() + duration_of(options_.measure);
    const std::unique_ptr<Rendering> rendering = backend->start(scene_, request);
    rendering->run([](double, const RenderStatistics&) { return !was_interrupted(); });
    const double seconds = rendering->statistics().render_seconds;
    Film film = rendering->film();
    measured_.samples = film.record.samples.count();
    measured_.seconds_per_sample = seconds / measured_.samples;
    error_ = estimate_error(film);
    measured_.relative_upper = error_.relative_upper(0.95);
    render_seconds_ = seconds;
    device_ = film.record.device;
    record_ = film.record;
    size_ = {film.window.full_width, film.window.full_height};
    pixels_ = {film.window.x, film.window.y, film.window.x + film.width,
               film.window.y + film.height};
    measured_.start_seconds += seconds_since_start() - start - seconds;
    film.has_squares = wants_variance(options_.render.aovs);
    measure_part(film, options_.render.writing.compression, measured_);
  }

  /// Of `facet render`, but for part, output and scene.
  [[nodiscard]] std::string render_options() const {
    const Division whole{{0, plan_.samples}, plan_.parts, pixels_, 1};
    std::string options = whole_options(whole, size_) + setting_options(record_, "--spp");
    const std::string& device = options_.render.backend.device;
    if (!device.empty()) options += " --device=" + shell_word(device);
    const ReadingRules& rules = options_.render.reading;
    if (rules.strict) options += " --strict";
    if (!rules.assets_below.empty())
      options +=
          " --assets-below=" +
          shell_word(std::filesystem::absolute(rules.assets_below).lexically_normal().string());
    if (wants_variance(options_.render.aovs)) options += " --aov=variance";
    if (options_.render.writing.compression != ExrCompression::zip)
      options += " --compression=none";
    return options;
  }

  void write_script() const {
    const std::filesystem::path scene =
        std::filesystem::absolute(options_.render.scene).lexically_normal();
    std::string merge_options = wants_variance(options_.render.aovs) ? "--aov=variance " : "";
    if (options_.render.writing.exposure != 0)
      merge_options += fmt::format("--exposure={}", options_.render.writing.exposure);
    write_text(
        options_.script,
        fmt::format("#!/bin/sh\n"
                    "# Submits a render to Slurm, in {} parts, and the merge of them, to the "
                    "folder it is\n"
                    "# started in. SBATCH_OPTIONS holds more options of sbatch, FACET the "
                    "program's name.\n"
                    "export FACET_MERGE_OPTIONS={}\n"
                    "exec sh {} {} . {}{}\n",
                    plan_.parts, shell_word(merge_options), shell_word(submit_script()),
                    plan_.parts, shell_word(scene.string()), render_options()));
  }

  /// submit.sh, where it is installed with the program or lies in its sources.
  static std::string submit_script() {
    std::error_code error;
    const std::filesystem::path folder =
        std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
    for (const char* place : {"../share/facet/farm/slurm", "../../../farm/slurm"}) {
      const std::filesystem::path script = folder / place / "submit.sh";
      if (std::filesystem::exists(script, error))
        return std::filesystem::canonical(script).string();
    }
    throw InputError(fmt::format(
        "farm-plan: --script: there is no ../share/facet/farm/slurm/submit.sh beside {}",
        folder.string()));
  }

  void tell() const {
    const tradeoff::FarmPlan& p = plan_;
    const auto pixels = static_cast<double>(area(pixels_));
    put("{}: {}x{} pixels, {}, on {}\n", options_.render.scene, pixels_.x1 - pixels_.x0,
        pixels_.y1 - pixels_.y0, record_.integrator, device_);
    const std::string error =
        measured_.relative_upper > 0
            ? fmt::format("{:.3g} % (at most {:.3g} %)", 100 * error_.relative(),
                          100 * measured_.relative_upper)
            : "unknown";
    put("measured: {} sample{} a pixel in {:.1f} s ({} samples/s), relative error {}, {:.2f} s to "
        "start and to write\n",
        measured_.samples, measured_.samples == 1 ? "" : "s", render_seconds_,
        with_unit_prefix(pixels / measured_.seconds_per_sample), error, measured_.start_seconds);
    put("samples:  {} a pixel{}\n", p.samples,
        wish_.error ? fmt::format(", for an error of {:.3g} %, which falls with their root",
                                  100 * *wish_.error)
                    : "");
    put("parts:    {} of {} samples, {} each\n", p.parts, p.part_samples, duration(p.part_seconds));
    put("nodes:    {}, at most {} part{} each: {} in all, {:.3g} node-hours{}\n", wish_.nodes,
        p.rounds, p.rounds == 1 ? "" : "s", duration(p.seconds), p.node_hours,
        p.parts < wish_.nodes ? fmt::format("; more than {} would mostly start", p.parts) : "");
    put("merging:  {}, of {}B of parts\n", duration(p.merge_seconds), with_unit_prefix(p.bytes));
    put("a part:   facet render{} --part=I/{} -- {}\n", render_options(), p.parts,
        shell_word(options_.render.scene));
    if (options_.script.empty()) {
      put("Slurm:    --script FILE writes what submits them\n");
    } else {
      put("Slurm:    sh {} submits them\n", shell_word(options_.script));
    }
  }

  static std::string duration(double seconds) {
    if (seconds < 60) return fmt::format("{:.3g} s", seconds);
    if (seconds < 3600) return fmt::format("{:.3g} min", seconds / 60);
    return fmt::format("{:.3g} h", seconds / 3600);
  }

  [[nodiscard]] std::string json_text() const {
    const tradeoff::FarmPlan& p = plan_;
    nlohmann::ordered_json json = {
        {"scene", options_.render.scene},
        {"device", device_},
        {"measured",
         {{"seconds", render_seconds_},
          {"spp", measured_.samples},
          {"samples_per_second", static_cast<double>(area(pixels_)) / measured_.seconds_per_sample},
          {"start_seconds", measured_.start_seconds},
          {"relative_error", error_.relative()},
          {"relative_upper95", measured_.relative_upper},
          {"part_bytes", measured_.part_bytes},
          {"merge_seconds", measured_.merge_seconds}}},
        {"nodes", wish_.nodes},
        {"spp", p.samples},
        {"parts", p.parts},
        {"part_spp", p.part_samples},
        {"part_seconds", p.part_seconds},
        {"merge_seconds", p.merge_seconds},
        {"seconds", p.seconds},
        {"node_hours", p.node_hours},
        {"bytes", p.bytes},
        {"render_options", render_options()},
        {"script", options_.script},
    };
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  }

  const FarmPlanOptions& options_;
  RenderRequest request_;
  tradeoff::FarmWish wish_;
  ScenePtr scene_;
  tradeoff::FarmMeasurement measured_;
  ErrorEstimate error_;
  double render_seconds_ = 0;
  std::string device_;
  RenderRecord record_;
  ImageSize size_;
  Crop pixels_;
  tradeoff::FarmPlan plan_;
};

}  // namespace

void add_farm_plan_command(CommandLine& line) {
  const auto options = std::make_shared<FarmPlanOptions>();
  FarmPlanOptions& o = *options;
  Command command = line.add(
      "farm-plan",
      "Plan a render on many nodes from a short measurement on this one: parts, time, node-hours, "
      "and the script that submits them");
  add_setting_options(command, o.render);
  command.describe("--spp", "Samples per pixel, of all parts together");
  command.text("--error", o.render.error,
               "Instead of --spp: plan for this relative error, 1% or 0.01");
  command.number("--nodes", o.nodes, 1U, 1000000U,
                 "Needed: how many nodes like this one there are");
  command.number("--measure", o.measure, 0.1, 1e6, "Seconds to measure for");
  command.number("--longest-part", o.longest_part, 1.0, 1e9,
                 "Seconds that a part may take, about; what is lost where a node fails is less, "
                 "since parts have checkpoints");
  command.text("--script", o.script, "Write a script that submits all to Slurm to this file");
  add_backend_options(command, o.render.backend);
  add_sampling_option(command, o.render.request.sampling, true);
  add_aov_option(command, o.render.aovs, false);
  add_writing_options(command, o.render.writing);
  command.action([options] { return FarmPlanJob(*options).run(); });
}

}  // namespace facet::cli
