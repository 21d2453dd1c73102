// facet merge: one image from renders of disjoint sample ranges.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/outputs.h"
#include "cli/part_file.h"
#include "cli/render_report.h"
#include "cli/text_file.h"
#include "core/print.h"
#include "core/text.h"
#include "image/part.h"

namespace facet::cli {

namespace {

using Metadata = std::vector<std::pair<std::string, std::string>>;

constexpr std::string_view device_separator = "; ";

struct MergeOptions {
  std::vector<std::string> parts;
  std::vector<std::string> outputs;
  std::vector<std::string> aovs;
  std::string sample_range;
  bool allow_gaps = false;
  float exposure = 0;
  std::string json;
  bool quiet = false;
};

/// The items of all parts' lists under a key, each once, in order.
std::string joined_lists(const std::vector<PartFile>& parts, const std::string& key) {
  std::vector<std::string> items;
  for (const PartFile& part : parts) {
    std::string_view rest = part.text(key);
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(device_separator), rest.size());
      const std::string item(rest.substr(0, end));
      if (std::find(items.begin(), items.end(), item) == items.end()) items.push_back(item);
      rest.remove_prefix(std::min(end + device_separator.size(), rest.size()));
    }
  }
  return fmt::format("{}", fmt::join(items, device_separator));
}

class MergeJob {
 public:
  explicit MergeJob(const MergeOptions& options) : options_(options) {}

  ExitCode run() {
    check_outputs(options_.outputs, {options_.json});
    open();
    check_parts_survive();
    check_gaps();
    join();
    write();
    if (!options_.json.empty()) write_text(options_.json, json_text() + '\n');
    if (!options_.quiet) print_summary();
    warn_about_heavy_tails(heavy_tails_);
    return ExitCode::done;
  }

 private:
  /// Reads the headers alone: whatever does not fit together is told before any pixel is read.
  void open() {
    for (const std::string& file : options_.parts) parts_.push_back(open_part(file));
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      check_same_render(parts_[i], parts_[0]);
      for (std::size_t k = 0; k < i; ++k) check_disjoint(parts_[i], parts_[k]);
      samples_.add(parts_[i].samples);
    }
    check_png_size(options_.outputs, parts_[0].header.width, parts_[0].header.height);
    // Sums depend on the order of their terms; the order on the command line must not matter.
    std::sort(parts_.begin(), parts_.end(), [](const PartFile& a, const PartFile& b) {
      return a.samples.hull().begin < b.samples.hull().begin;
    });
  }

  /// An EXR that takes a part's place holds its samples; anything else would lose them.
  void check_parts_survive() const {
    std::vector<std::string> others{options_.json};
    for (const std::string& file : options_.outputs) {
      if (!is_exr(file)) others.push_back(file);
    }
    check_no_input_is_written(others, {options_.parts.begin(), options_.parts.end()});
  }

  void check_gaps() const {
    SampleRange whole = samples_.hull();
    if (!options_.sample_range.empty()) {
      const auto asked = SampleRanges::parse(options_.sample_range);
      if (!asked || asked->list().size() != 1)
        throw InputError(fmt::format("--sample-range \"{}\": A:B expected", options_.sample_range));
      whole = asked->hull();
      check_inside(whole);
    }
    const SampleRanges missing = samples_.missing_in(whole);
    if (missing.empty() || options_.allow_gaps) return;
    throw InputError(
        fmt::format("no part holds the samples {} of {}:{}; render them, or merge with --allow-gaps",
                    missing.text(), whole.begin, whole.end));
  }

  void check_inside(const SampleRange& whole) const {
    SampleRanges asked;
    asked.add(whole);
    for (const PartFile& part : parts_) {
      const SampleRanges outside = asked.missing_in(part.samples.hull());
      if (outside.empty()) continue;
      throw InputError(fmt::format("{}: holds samples outside --sample-range {}:{}: {}", part.file,
                                   whole.begin, whole.end, part.samples.text()));
    }
  }

  void check_squares() const {
    const auto lacks = [](const PartFile& part) { return !part.has_squares(); };
    const auto without = std::find_if(parts_.begin(), parts_.end(), lacks);
    if (without == parts_.end()) return;
    if (wants_variance(options_.aovs)) {
      throw InputError(
          fmt::format("{}: holds no sums of squares, which --aov variance needs; render it with "
                      "--aov variance",
                      without->file));
    }
    if (std::all_of(parts_.begin(), parts_.end(), lacks)) return;
    say("warning: {}: holds no sums of squares, so the merged image keeps none\n", without->file);
  }

  void join() {
    check_squares();
    film_ = parts_[0].read();
    for (std::size_t i = 1; i < parts_.size(); ++i) add_samples(film_, parts_[i].read());
    relmse_ = estimate_relmse(film_);
    heavy_tails_ = find_heavy_tails(film_);
  }

  /// The header of the first samples' part, with what the parts differ in replaced.
  [[nodiscard]] Metadata make_metadata() const {
    const std::vector<std::pair<std::string, std::string>> replaced{
        {"facet.samples", samples_.text()},
        {"facet.spp", fmt::format("{}", samples_.count())},
        {"facet.seconds", fmt::format("{:.3f}", seconds())},
        {"facet.device", joined_lists(parts_, "facet.device")},
        {"facet.driver", joined_lists(parts_, "facet.driver")},
    };
    Metadata metadata = replaced;
    for (const auto& entry : parts_[0].header.metadata) {
      const bool ours = entry.first.starts_with("facet.") && !entry.first.ends_with("Exponent");
      if (ours && find_metadata(replaced, entry.first) == nullptr) metadata.push_back(entry);
    }
    return metadata;
  }

  /// Seconds of rendering, of all parts together.
  [[nodiscard]] double seconds() const {
    double sum = 0;
    for (const PartFile& part : parts_) sum += parse_real(part.text("facet.seconds")).value_or(0);
    return sum;
  }

  void write() {
    Image image = make_part(film_, wants_variance(options_.aovs));
    Metadata metadata = make_metadata();
    metadata.insert(metadata.end(), image.metadata.begin(), image.metadata.end());
    image.metadata = std::move(metadata);
    written_ = write_images(options_.outputs, image, options_.exposure);
  }

  [[nodiscard]] std::string json_text() const {
    const PartFile& first = parts_[0];
    nlohmann::ordered_json json = {
        {"scene", first.text("facet.scene")},
        {"device", joined_lists(parts_, "facet.device")},
        {"driver", joined_lists(parts_, "facet.driver")},
        {"backend", first.text("facet.backend")},
        {"integrator", first.text("facet.integrator")},
        {"sampler", first.text("facet.sampler")},
        {"width", film_.width},
        {"height", film_.height},
        {"spp", samples_.count()},
        {"samples", samples_.text()},
        {"missing", samples_.missing_in(samples_.hull()).text()},
        {"seed", parse_integer(first.text("facet.seed")).value_or(0)},
        {"fingerprint", first.text("facet.fingerprint")},
        {"seconds", {{"render", seconds()}, {"total", seconds_since_start()}}},
        {"parts", options_.parts},
        {"output", written_},
    };
    if (film_.has_squares) {
      json["error_estimate"] = {{"relmse", relmse_}, {"relative", std::sqrt(relmse_)}};
      json["heavy_tails"] = json_of(heavy_tails_);
    }
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  }

  void print_summary() const {
    const SampleRanges missing = samples_.missing_in(samples_.hull());
    say("{}: {} part{} of {}x{} pixels, {} samples each ({}{})\n", parts_[0].text("facet.scene"),
        parts_.size(), parts_.size() == 1 ? "" : "s", film_.width, film_.height, samples_.count(),
        samples_.text(), missing.empty() ? "" : "; missing: " + missing.text());
    say("wrote {}\n", fmt::join(written_, " and "));
  }

  const MergeOptions& options_;
  std::vector<PartFile> parts_;
  SampleRanges samples_;
  Film film_;
  double relmse_ = 0;  ///< estimated
  HeavyTails heavy_tails_;
  std::vector<std::string> written_;  ///< files
};

void add_options(CLI::App& command, MergeOptions& o) {
  command.add_option("parts", o.parts, "EXR files that facet render --sample-range or facet merge wrote")
      ->required();
  command
      .add_option("-o,--output", o.outputs,
                  "Image to write, .exr or .png; may be repeated. An EXR is a part again")
      ->required()
      ->allow_extra_args(false);
  command.add_option("--sample-range", o.sample_range,
                     "Refuse unless the parts hold just the samples A:B together (B excluded)");
  command.add_flag("--allow-gaps", o.allow_gaps, "Merge although samples between the parts are missing");
  add_aov_option(command, o.aovs);
  add_exposure_option(command, o.exposure);
  command.add_option("--json", o.json, "Write a report to this file, - for standard output");
  command.add_flag("--quiet", o.quiet, "Nothing but errors and warnings on standard error");
}

}  // namespace

void add_merge_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<MergeOptions>();
  CLI::App* command = app.add_subcommand("merge", "Join renders of disjoint sample ranges");
  add_options(*command, *options);
  command->callback([options, &action] { action = [options] { return MergeJob(*options).run(); }; });
}

}  // namespace facet::cli
