// facet tradeoff: error against seconds over what whoever renders can choose.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/render_options.h"
#include "core/print.h"
#include "core/text_file.h"
#include "door/warnings.h"
#include "report/tradeoff_page.h"

namespace facet::cli {

namespace {

struct TradeoffCommandOptions {
  RenderOptions render;
  tradeoff::Options tradeoff;
  std::optional<std::string> recommend;
  std::string html;
};

/// What is being done, and how far it is, on standard error.
class Narrator {
 public:
  explicit Narrator(bool quiet) : quiet_(quiet) {}

  void tell(double done, const std::string& what) {
    if (quiet_ || what == last_) return;
    last_ = what;
    say("{:3.0f} %  {}\n", 100 * done, what);
  }

 private:
  bool quiet_;
  std::string last_;
};

class TradeoffJob {
 public:
  explicit TradeoffJob(const TradeoffCommandOptions& options) : options_(options) {}

  ExitCode run() {
    const RenderOptions& o = options_.render;
    check_outputs({}, {o.json, options_.html});
    std::optional<double> wanted;
    if (options_.recommend) wanted = parse_relative_error(*options_.recommend, "--recommend");
    load();
    catch_interrupts();
    const std::unique_ptr<Backend> backend = open_backend(o.backend.options());
    Narrator narrator(o.quiet);
    const auto measured =
        tradeoff::measure(*backend, scene_, study_, [&](double done, const std::string& what) {
          narrator.tell(done, what);
          return !was_interrupted();
        });
    if (!measured) {
      say("interrupted before there was anything to tell\n");
      return ExitCode::interrupted;
    }
    return report({*measured, wanted});
  }

 private:
  void load() {
    const RenderOptions& o = options_.render;
    Diagnostics diagnostics(o.reading);
    scene_ = std::make_shared<const Scene>(read_scene(o.scene, diagnostics, overridden_by(o)));
    std::vector<std::filesystem::path> inputs = diagnostics.inputs();
    if (!options_.tradeoff.reference.empty()) inputs.emplace_back(options_.tradeoff.reference);
    check_no_input_is_written({o.json, options_.html}, inputs);
    study_ = options_.tradeoff;
    study_.base = make_request(o);
    study_.pictures = !options_.html.empty();
    RenderRequest longest = study_.base;
    if (!longest.samples) longest.samples = tradeoff::default_most_samples;
    warn_about_render(*scene_, resolve(*scene_, longest), diagnostics);
    print_warnings(diagnostics);
  }

  [[nodiscard]] ExitCode report(const report::TradeoffReport& report) const {
    const RenderOptions& o = options_.render;
    const tradeoff::Tradeoff& t = report.tradeoff;
    if (!o.json.empty()) write_text(o.json, report::tradeoff_json(report).dump(1) + '\n');
    if (!options_.html.empty()) report::write_tradeoff_page(options_.html, report);
    if (o.json != "-") {
      const std::string command = report::advised_command(report);
      put_text(o.quiet && !command.empty() ? command + '\n' : report::text_of(report));
    }
    if (t.bound_hits > 0)
      say("warning: {} rays were stopped by the safety bound of traversal\n", t.bound_hits);
    if (t.interrupted) say("interrupted: this is what was measured until then\n");
    if (t.interrupted) return ExitCode::interrupted;
    return t.bound_hits == 0 ? ExitCode::done : ExitCode::check_failed;
  }

  const TradeoffCommandOptions& options_;
  ScenePtr scene_;
  tradeoff::Options study_;
};

}  // namespace

void add_tradeoff_command(CommandLine& line) {
  const auto options = std::make_shared<TradeoffCommandOptions>();
  TradeoffCommandOptions& o = *options;
  Command command = line.add(
      "tradeoff",
      "Measure what the choices of a render cost and buy: error against seconds of each alone, and "
      "of the best together");
  add_setting_options(command, o.render);
  command.describe("--spp",
                   fmt::format("The most samples a pixel; a quarter and a sixteenth of them are "
                               "measured, too. {} unless given, or fewer, {} at least, where "
                               "--resolution, --crop or --reference decide the size and the budget "
                               "is too small for so many",
                               tradeoff::default_most_samples, least_adaptive_samples));
  command.describe(
      "--resolution",
      "Size of the images, WxH; otherwise the scene's own, or less where the budget is "
      "too small for it");
  command.number("--budget", o.tradeoff.budget, 1.0, 1e9, "Seconds for all of it, about");
  command.text("--reference", o.tradeoff.reference,
               "Image to measure errors against, of the same size; otherwise one is rendered, in "
               "three tenths of the budget at most, but with 16 times the samples at least");
  command.text(
      "--recommend", o.recommend,
      "Say how to reach this relative error soonest, 1% or 0.01; with --quiet, the command "
      "alone");
  command.flag("--exhaustive", o.tradeoff.exhaustive,
               "Measure all combinations of choices without bias, not only those on the way to the "
               "best; needs a large budget");
  command.text("--html", o.html,
               "Write a page with the plot, and images at equal time, to this file");
  add_device_option(command, o.render.backend.device);
  add_sampling_option(command, o.render.request.sampling, false);
  command.action([options] { return TradeoffJob(*options).run(); });
}

}  // namespace facet::cli
