// facet parity: the kernels against the reference in two precisions, every difference explained.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/render_options.h"
#include "core/print.h"
#include "core/text_file.h"
#include "core/words.h"
#include "door/warnings.h"
#include "image/record.h"
#include "image/rerun.h"
#include "parity/parity.h"
#include "render/kernel_backend.h"

namespace facet::cli {

namespace {

constexpr int default_spp = 4;
constexpr double most_samples = 2.5e8;
/// Diverged samples that are listed for people.
constexpr std::size_t listed_samples = 10;
constexpr std::size_t listed_suspects = 5;

class ParityJob {
 public:
  explicit ParityJob(const RenderOptions& options) : options_(options) {}

  ExitCode run() {
    check_outputs({}, {options_.json});
    load();
    catch_interrupts();
    compare();
    if (!options_.json.empty()) write_text(options_.json, json_text() + '\n');
    if (options_.json != "-") print();
    if (was_interrupted()) return ExitCode::interrupted;
    return failings_.empty() ? ExitCode::done : ExitCode::check_failed;
  }

 private:
  void load() {
    Diagnostics diagnostics(options_.reading);
    scene_ = std::make_shared<const Scene>(
        read_scene(options_.scene, diagnostics, overridden_by(options_)));
    check_no_input_is_written({options_.json}, diagnostics.inputs());
    RenderRequest request = make_request(options_);
    if (!request.samples) request.samples = default_spp;
    settings_ = resolve(*scene_, request);
    settings_.variance = true;
    check_sample_count();
    warn_about_render(*scene_, settings_, diagnostics);
    print_warnings(diagnostics);
  }

  /// A figure is kept of each sample.
  void check_sample_count() const {
    const auto samples = static_cast<double>(settings_.total_samples());
    if (samples > most_samples)
      throw InputError(fmt::format(
          "parity: {:.2g} samples are more than {:.2g}; use --crop, --resolution or --spp", samples,
          most_samples));
  }

  void compare() {
    KernelBackend kernels(options_.backend.device, false);
    device_ = kernels.device().info();
    const parity::Tolerance tolerance = parity::tolerance_on(kernels.device().is_cpu());
    const std::unique_ptr<Rendering> rendering = kernels.start(scene_, settings_);
    record_ = rendering->record();
    Progress progress(options_.quiet, {});
    report_ = parity::check_parity(*scene_, settings_, tolerance, *rendering, [&](double done) {
      RenderStatistics statistics = rendering->statistics();
      statistics.render_seconds = seconds_since_start();
      progress.update(done, statistics);
      return !was_interrupted();
    });
    progress.finish();
    failings_ = report_.failings();
    if (const std::uint64_t hits = rendering->statistics().bound_hits; hits > 0)
      failings_.push_back(
          fmt::format("{} rays were stopped by the safety bound of traversal", hits));
  }

  /// The command that renders one sample again.
  [[nodiscard]] std::string command_for(const parity::DivergedSample& d) const {
    RenderRecord sample = record_;
    sample.samples = SampleRanges(SampleRange{d.sample, d.sample + 1});
    return rerun_command(sample, settings_.size, d.x, d.y);
  }

  [[nodiscard]] std::string json_text() const {
    const parity::ParityReport& r = report_;
    nlohmann::ordered_json diverged = nlohmann::ordered_json::array();
    for (const parity::DivergedSample& d : r.diverged) {
      nlohmann::ordered_json decisions = nlohmann::ordered_json::array();
      for (std::size_t i = 0; i < d.turned.size(); ++i) {
        const parity::TurnedDecision& t = d.turned[i];
        decisions.push_back({{"kind", reference::decision_name(t.key.kind)},
                             {"where", d.reasons[i]},
                             {"interaction", t.key.ray / 2 + 1},
                             {"shadow", t.key.ray % 2 == 1},
                             {"margin", t.margin},
                             {"spread", t.spread}});
      }
      diverged.push_back({{"pixel", {d.x, d.y}},
                          {"sample", d.sample},
                          {"kernels", {d.kernels.x, d.kernels.y, d.kernels.z}},
                          {"reference", {d.reference.x, d.reference.y, d.reference.z}},
                          {"explained", !d.turned.empty()},
                          {"decided_by_least", d.nearest},
                          {"command", command_for(d)},
                          {"decisions", decisions}});
    }
    nlohmann::ordered_json suspects = nlohmann::ordered_json::array();
    for (const parity::Suspect& s : r.suspects)
      suspects.push_back(
          {{"part", s.part}, {"score", s.score}, {"failing", s.failing}, {"passing", s.passing}});
    const nlohmann::ordered_json json = {
        {"scene", options_.scene},
        {"device", device_.name},
        {"driver", device_.driver},
        {"integrator", record_.integrator},
        {"sampling", word_of(lobe_sampling_words, record_.sampling)},
        {"complete", !was_interrupted()},
        {"samples", r.samples},
        {"tolerance",
         {{"relative", r.tolerance.relative}, {"spread_factor", r.tolerance.spread_factor}}},
        {"code",
         {{"identical_samples", r.identical},
          {"identical_pixels", r.identical_pixels},
          {"pixels", r.pixels},
          {"ill_conditioned_samples", r.ill_conditioned},
          {"untestable_samples", r.untestable},
          {"largest_relative_difference", r.largest_difference},
          {"percentile_99_9", r.percentile_difference},
          {"diverged_samples", r.diverged.size()},
          {"unexplained_samples", r.unexplained()},
          {"film_difference", r.film_difference}}},
        {"precision",
         {{"same_branches", r.same_branches},
          {"rms", r.precision_rms},
          {"largest", r.largest_precision},
          {"noise_1024", r.noise_1024},
          {"block_z", r.block_z},
          {"critical_z", r.critical_z}}},
        {"bad_samples",
         {{"kernels", r.bad_kernel_samples}, {"reference", r.bad_reference_samples}}},
        {"diverged", diverged},
        {"suspects", suspects},
        {"failings", failings_},
        {"passed", failings_.empty()},
    };
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  }

  void print() const {
    const parity::ParityReport& r = report_;
    const auto share = [](std::uint64_t part, std::uint64_t whole) {
      return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 100.0;
    };
    put("{}: {}, {} sampling, {} samples on {}\n", options_.scene, record_.integrator,
        word_of(lobe_sampling_words, record_.sampling), r.samples, device_.name);
    put("kernels against reference in float (tolerance {:g} |F| + {:g} s):\n", r.tolerance.relative,
        r.tolerance.spread_factor);
    put("  equal in all bits        {:.2f} % of samples, {:.2f} % of pixels\n",
        share(r.identical, r.samples), share(r.identical_pixels, r.pixels));
    put("  relative difference      {:.2g} at the 99.9th percentile, {:.2g} at most where they "
        "agree\n",
        r.percentile_difference, r.largest_difference);
    put("  within their spread only {} samples; {} have a spread beyond 10 % of themselves\n",
        r.ill_conditioned, r.untestable);
    put("  diverged                 {} samples ({:.4f} %), {} unexplained\n", r.diverged.size(),
        share(r.diverged.size(), r.samples), r.unexplained());
    put("  film against its samples {:.2g}\n", r.film_difference);
    put("reference in float against double:\n");
    put("  same branches            {:.3f} % of samples\n", share(r.same_branches, r.samples));
    print_noise();
    print_diverged();
    for (const std::string& line : failings_) put("FAILED: {}\n", line);
    if (was_interrupted()) put("interrupted: this is what was compared until then\n");
    if (failings_.empty() && !was_interrupted()) put("parity holds\n");
  }

  void print_noise() const {
    const parity::ParityReport& r = report_;
    if (!r.noise_known) {
      put("  RMS difference           {:.2g}, {:.2g} at most; the noise of one sample a pixel is "
          "unknown\n",
          r.precision_rms, r.largest_precision);
      return;
    }
    put("  RMS difference           {:.2g}, {:.2g} of the noise of 1024 samples; {:.2g} at most\n",
        r.precision_rms, r.noise_1024 > 0 ? r.precision_rms / r.noise_1024 : 0.0,
        r.largest_precision);
    put("  means of 16x16 pixels    largest z {:.2f} of {:.2f}\n", r.block_z, r.critical_z);
  }

  void print_diverged() const {
    std::vector<parity::DivergedSample> list = report_.diverged;
    std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) {
      return a.turned.empty() > b.turned.empty();
    });
    for (std::size_t i = 0; i < std::min(list.size(), listed_samples); ++i) {
      const parity::DivergedSample& d = list[i];
      put("pixel {},{} sample {}: kernels {:.6g} {:.6g} {:.6g}, reference {:.6g} {:.6g} {:.6g}\n",
          d.x, d.y, d.sample, d.kernels.x, d.kernels.y, d.kernels.z, d.reference.x, d.reference.y,
          d.reference.z);
      if (d.turned.empty()) {
        put("  UNEXPLAINED; again (and with --backend reference): {}\n", command_for(d));
        put("  decided by least: {}\n", d.nearest);
      }
      for (const std::string& reason : d.reasons) put("  turned: {}\n", reason);
    }
    if (list.size() > listed_samples)
      put("and {} more (--json lists all)\n", list.size() - listed_samples);
    if (report_.suspects.empty()) return;
    put("what the unexplained samples have in common (1: they all, and no other sample, use "
        "it):\n");
    for (std::size_t i = 0; i < std::min(report_.suspects.size(), listed_suspects); ++i) {
      const parity::Suspect& s = report_.suspects[i];
      put("  {:.3f}  {} ({} unexplained samples, {} others)\n", s.score, s.part, s.failing,
          s.passing);
    }
  }

  const RenderOptions& options_;
  ScenePtr scene_;
  RenderSettings settings_;
  RenderRecord record_;
  gpu::DeviceInfo device_;
  parity::ParityReport report_;
  std::vector<std::string> failings_;
};

}  // namespace

void add_parity_command(CommandLine& line) {
  const auto options = std::make_shared<RenderOptions>();
  Command command = line.add(
      "parity",
      "Compare the kernels with the CPU reference in two precisions, sample by sample (4 samples a "
      "pixel by default), and explain every difference; exits 1 where one cannot be explained");
  add_scene_options(command, *options);
  add_device_option(command, options->backend.device);
  add_sampling_option(command, options->request.sampling, false);
  command.action([options] { return ParityJob(*options).run(); });
}

}  // namespace facet::cli
