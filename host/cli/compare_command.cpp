// facet compare: the error of an image against a reference.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/outputs.h"
#include "core/print.h"
#include "core/text.h"
#include "core/text_file.h"
#include "image/files.h"
#include "report/compare_page.h"
#include "report/compare_report.h"
#include "report/compare_summary.h"

namespace facet::cli {

namespace {

/// Columns of a text, whose characters may take several bytes.
std::size_t columns(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

struct CompareCommand {
  CompareOptions comparison;
  std::string json;
  std::string html;
  std::string junit;
  std::string summary;
};

void print_table(const CompareOptions& options, const Comparison& comparison) {
  put("{} against the reference {}, {}x{} pixels\n", options.image, options.reference,
      comparison.image.width(), comparison.image.height());
  const std::vector<report::MetricRow> rows = report::metric_rows(options, comparison);
  std::size_t width = 0;
  for (const report::MetricRow& row : rows) width = std::max(width, columns(row.value));
  for (const report::MetricRow& row : rows) {
    put("  {:<16}  {}{}  {}\n", row.name, row.value, std::string(width - columns(row.value), ' '),
        row.note);
  }
}

void check_files(const CompareCommand& c) {
  if (c.html == "-") throw InputError("--html needs a file; standard output carries the figures");
  const std::vector<std::string> outputs{c.json, c.html, c.junit, c.summary};
  check_outputs({}, outputs);
  check_no_input_is_written(outputs, {c.comparison.image, c.comparison.reference});
}

ExitCode compare(const CompareCommand& command) {
  const CompareOptions& options = command.comparison;
  check_files(command);
  const Comparison comparison = compare_images(options);
  if (!command.html.empty()) report::write_compare_page(command.html, options, comparison);
  if (!command.json.empty()) {
    const std::string text =
        report::comparison_json(options, comparison)
            .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    write_text(command.json, text + "\n");
  }
  if (!command.junit.empty())
    write_text(command.junit, report::comparison_junit(options, comparison));
  if (!command.summary.empty())
    append_text(command.summary, report::comparison_markdown(options, comparison));
  if (command.json != "-") print_table(options, comparison);
  for (const std::string& warning : comparison.warnings) say("warning: {}\n", warning);
  const std::vector<std::string> violations = comparison.violations();
  for (const std::string& violation : violations) say("facet: {}\n", violation);
  return violations.empty() ? ExitCode::done : ExitCode::check_failed;
}

void add_thresholds(Command& command, CompareOptions& o) {
  command.group("Thresholds (exit code 1 where one does not hold)");
  command.number("--max-mean", o.max_mean, 0, INFINITY,
                 "How far the ratio of the means of R, G or B may be from 1");
  command.number("--max-abs", o.max_abs, 0, INFINITY, "Largest difference of a channel");
  command.number("--max-rmse", o.max_rmse, 0, INFINITY, "Root of the mean squared difference");
  command.number("--max-relmse", o.max_relmse, 0, INFINITY,
                 "Mean squared difference relative to the reference");
  command.number("--max-flip", o.max_flip, 0, 1, "Mean LDR-FLIP");
  command.number("--max-hdrflip", o.max_hdrflip, 0, 1, "Mean HDR-FLIP");
  command.number("--min-identical", o.min_identical, 0, 1, "Least share of bit-identical pixels");
  command.number("--max-beyond", o.max_beyond, 0, 1, "Share of pixels beyond --tolerance");
  command.flag(
      "--z-test", o.z_test,
      "Both images estimate the same expectation; both need the channels of --aov variance");
  command.group("");
}

}  // namespace

void add_compare_command(CommandLine& line) {
  const auto options = std::make_shared<CompareCommand>();
  CompareOptions& o = options->comparison;
  Command command = line.add("compare", "Measure the error of an image against a reference");
  command.argument("image", o.image, "Image: EXR, PNG, JPEG or Radiance HDR");
  command.argument("reference", o.reference, "Reference image of the same size");
  add_thresholds(command, o);
  command.number("--tolerance", o.tolerance, 0, INFINITY,
                 "T: a pixel is beyond it if |a - r| > T (|r| + 0.01 mean luminance of r) in a "
                 "channel");
  command.number("--significance", o.significance, 1e-15, 0.5,
                 "Of the z-test: how often equal expectations may fail it");
  command.number("--ppd", o.pixels_per_degree, 1, 1000,
                 "Of FLIP: pixels in a degree of the viewer's visual angle");
  command.flag("--trim", o.trim,
               "--max-relmse bounds the relMSE without the 0.1 % largest pixel terms");
  add_json_option(command, options->json);
  command.text("--html", options->html,
               "Write a self-contained page that shows images, differences and the worst pixels");
  command.text("--junit", options->junit, "Write JUnit XML to this file, a test case a threshold");
  command.text("--summary", options->summary,
               "Append verdict, figures and a map of the errors in Markdown to this file, as CI "
               "hosts show it");
  command.action([options] { return compare(*options); });
}

}  // namespace facet::cli
