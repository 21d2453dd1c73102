// facet merge: one image from renders of parts of its samples and of its pixels.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/outputs.h"
#include "cli/render_report.h"
#include "core/print.h"
#include "core/text.h"
#include "core/text_file.h"
#include "parts/find_parts.h"
#include "parts/merge.h"
#include "parts/missing.h"
#include "parts/part.h"

namespace facet::cli {

namespace {

struct MergeOptions {
  std::vector<std::string> parts;
  std::vector<std::string> outputs;
  std::vector<std::string> aovs;
  std::string sample_range;
  bool allow_gaps = false;
  WriteOptions writing;
  std::string json;
  bool quiet = false;
};

class MergeJob {
 public:
  explicit MergeJob(const MergeOptions& options) : options_(options) {}

  ExitCode run() {
    check_outputs(options_.outputs, {options_.json});
    files_ = find_parts(options_.parts, options_.outputs);
    parts_ = open_parts(files_);
    const Crop pixels = parts_.pixels();
    check_png_size(options_.outputs, pixels.x1 - pixels.x0, pixels.y1 - pixels.y0);
    check_parts_survive();
    check_gaps();
    check_squares();
    film_ = merge(parts_);
    error_ = estimate_error(film_);
    heavy_tails_ = find_heavy_tails(film_);
    written_ = write_images(options_.outputs, make_part(film_, wants_variance(options_.aovs)),
                            options_.writing);
    if (!options_.json.empty()) write_text(options_.json, json_text() + '\n');
    if (!options_.quiet) print_summary();
    warn_about_heavy_tails(heavy_tails_);
    return ExitCode::done;
  }

 private:
  /// An EXR that takes a part's place holds its samples; anything else would lose them.
  void check_parts_survive() const {
    std::vector<std::string> others{options_.json};
    for (const std::string& file : options_.outputs) {
      if (!is_exr(file)) others.push_back(file);
    }
    check_no_input_is_written(others, {files_.begin(), files_.end()});
  }

  void check_gaps() const {
    std::optional<SampleRange> range;
    if (!options_.sample_range.empty()) {
      const auto asked = SampleRanges::parse(options_.sample_range);
      if (!asked || asked->list().size() != 1)
        throw InputError(fmt::format("--sample-range \"{}\": A:B expected", options_.sample_range));
      range = asked->hull();
      check_inside(parts_, *range);
    }
    if (!options_.allow_gaps && !range) print_missing();
    check_whole(parts_, range, options_.allow_gaps);
  }

  /// The commands that render what no part holds.
  void print_missing() const {
    const std::vector<TileShare> missing = missing_shares(parts_);
    if (!missing.empty()) say("missing; in the folder of {}:\n", parts_.record.scene);
    for (const TileShare& share : missing) say("  {}\n", share_command(parts_, share));
  }

  void check_squares() const {
    const std::vector<PartEntry>& parts = parts_.parts;
    const auto lacks = [](const PartEntry& part) { return !part.has_squares; };
    const auto without = std::find_if(parts.begin(), parts.end(), lacks);
    if (without == parts.end()) return;
    if (wants_variance(options_.aovs)) {
      throw InputError(
          fmt::format("{}: holds no sums of squares, which --aov variance needs; render it with "
                      "--aov variance",
                      without->file));
    }
    if (std::all_of(parts.begin(), parts.end(), lacks)) return;
    say("warning: {}: holds no sums of squares, so the merged image keeps none\n", without->file);
  }

  [[nodiscard]] std::string json_text() const {
    const RenderRecord& record = film_.record;
    nlohmann::ordered_json json = {{"scene", record.scene}};
    json.update(json_of(record));
    json.update({
        {"width", film_.width},
        {"height", film_.height},
        {"missing", missing().text()},
        {"missing_shares", missing_text()},
        {"seconds", {{"render", record.seconds}, {"total", seconds_since_start()}}},
        {"parts", files_},
        {"output", written_},
    });
    if (film_.has_squares) {
      json["error_estimate"] = json_of(error_);
      json["heavy_tails"] = json_of(heavy_tails_);
    }
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  }

  void print_summary() const {
    const SampleRanges gaps = missing();
    const std::size_t count = parts_.parts.size();
    const std::size_t tiles = parts_.tiles.size();
    say("{}: {} part{}{} of {}x{} pixels, {} samples each ({}{})\n", film_.record.scene, count,
        count == 1 ? "" : "s", tiles == 1 ? "" : fmt::format(" in {} tiles", tiles), film_.width,
        film_.height, film_.record.samples.count(), film_.record.samples.text(),
        gaps.empty() ? "" : "; missing: " + gaps.text());
    const std::string shares = missing_text();
    if (!shares.empty()) say("missing: {}\n", shares);
    say("wrote {}\n", fmt::join(written_, " and "));
  }

  /// For people: shares of the division that no part holds.
  [[nodiscard]] std::string missing_text() const {
    const std::vector<TileShare> shares = missing_shares(parts_);
    return shares.empty() ? "" : describe(shares, *parts_.record.division);
  }

  [[nodiscard]] SampleRanges missing() const {
    return film_.record.samples.missing_in(parts_.whole_samples());
  }

  const MergeOptions& options_;
  std::vector<std::string> files_;
  PartSet parts_;
  Film film_;
  ErrorEstimate error_;
  HeavyTails heavy_tails_;
  std::vector<std::string> written_;  ///< files
};

}  // namespace

void add_merge_command(CommandLine& line) {
  const auto options = std::make_shared<MergeOptions>();
  MergeOptions& o = *options;
  Command command =
      line.add("merge", "Join renders of parts of the samples, and of tiles of the image");
  command.arguments("parts", o.parts,
                    "EXR files that facet render --part, --tile or --sample-range, or facet merge "
                    "wrote; folders of them, and patterns such as 'parts/*.exr'");
  command.texts("-o,--output", o.outputs,
                "Image to write, .exr or .png; may be repeated. An EXR is a part again", true);
  command.text("--sample-range", o.sample_range,
               "Refuse unless the parts hold just the samples A:B together (B excluded)");
  command.flag("--allow-gaps", o.allow_gaps,
               "Merge although samples between the parts are missing");
  add_aov_option(command, o.aovs, false);
  add_writing_options(command, o.writing);
  add_report_options(command, o.json, o.quiet);
  command.action([options] { return MergeJob(*options).run(); });
}

}  // namespace facet::cli
