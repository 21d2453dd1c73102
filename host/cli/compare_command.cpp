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
  check_outputs({}, {c.json, c.html});
  check_no_input_is_written({c.json, c.html}, {c.comparison.image, c.comparison.reference});
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
  if (command.json != "-") print_table(options, comparison);
  for (const std::string& warning : comparison.warnings) say("warning: {}\n", warning);
  for (const std::string& violation : comparison.violations) say("facet: {}\n", violation);
  return comparison.violations.empty() ? ExitCode::done : ExitCode::check_failed;
}

/// Numbers from low to high; CLI11's own check lets NaN pass.
CLI::Validator number_between(double low, double high, const std::string& what) {
  const auto check = [=](const std::string& text) {
    const std::optional<double> value = parse_real(text);
    const bool fits = value && *value >= low && *value <= high;
    return fits ? std::string() : fmt::format("\"{}\" is not {}", text, what);
  };
  return {check, ""};
}

void add_thresholds(CLI::App& command, CompareOptions& o) {
  const CLI::Validator bound = number_between(0, INFINITY, "a number of at least 0");
  const CLI::Validator share = number_between(0, 1, "a share from 0 to 1");
  const auto add = [&command](const char* name, std::optional<double>& value, const char* help,
                              const CLI::Validator& check) {
    command.add_option(name, value, help)
        ->check(check)
        ->group("Thresholds (exit code 1 where one does not hold)");
  };
  add("--max-abs", o.max_abs, "Largest difference of a channel", bound);
  add("--max-rmse", o.max_rmse, "Root of the mean squared difference", bound);
  add("--max-relmse", o.max_relmse, "Mean squared difference relative to the reference", bound);
  add("--max-flip", o.max_flip, "Mean LDR-FLIP", share);
  add("--max-hdrflip", o.max_hdrflip, "Mean HDR-FLIP", share);
  add("--min-identical", o.min_identical, "Least share of bit-identical pixels", share);
  add("--max-beyond", o.max_beyond, "Share of pixels beyond --tolerance", share);
  command
      .add_flag(
          "--z-test", o.z_test,
          "Both images estimate the same expectation; both need the channels of --aov variance")
      ->group("Thresholds (exit code 1 where one does not hold)");
}

}  // namespace

void add_compare_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<CompareCommand>();
  CompareOptions& o = options->comparison;
  CLI::App* command =
      app.add_subcommand("compare", "Measure the error of an image against a reference");
  command->add_option("image", o.image, "Image, .exr or .png")->required();
  command->add_option("reference", o.reference, "Reference image of the same size, .exr or .png")
      ->required();
  add_thresholds(*command, o);
  command
      ->add_option(
          "--tolerance", o.tolerance,
          "T: a pixel is beyond it if |a - r| > T (|r| + 0.01 mean luminance of r) in a channel")
      ->check(number_between(0, INFINITY, "a number of at least 0"))
      ->capture_default_str();
  command
      ->add_option("--significance", o.significance,
                   "Of the z-test: how often equal expectations may fail it")
      ->check(number_between(1e-15, 0.5, "a significance from 1e-15 to 0.5"))
      ->capture_default_str();
  command
      ->add_option("--ppd", o.pixels_per_degree,
                   "Of FLIP: pixels in a degree of the viewer's visual angle")
      ->check(number_between(1, 1000, "a number from 1 to 1000"))
      ->capture_default_str();
  command->add_flag("--trim", o.trim,
                    "--max-relmse bounds the relMSE without the 0.1 % largest pixel terms");
  command->add_option("--json", options->json,
                      "Write a report to this file, - for standard output");
  command->add_option(
      "--html", options->html,
      "Write a self-contained page that shows images, differences and the worst pixels");
  command->callback([options, &action] { action = [options] { return compare(*options); }; });
}

}  // namespace facet::cli
