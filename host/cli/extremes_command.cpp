// facet extremes: numbers at the edge.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/backend_options.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "core/print.h"
#include "core/text_file.h"
#include "extremes/extremes.h"
#include "image/files.h"
#include "report/extremes_report.h"

namespace facet::cli {

namespace {

struct ExtremesOptions {
  std::string device;
  std::vector<std::string> only;
  std::string json;
  std::string html;
  bool quick = false;
  bool validate = false;
};

/// The checks whose group or name has one of these words in it; all without any.
std::vector<extremes::Check> chosen(const std::vector<std::string>& words) {
  std::vector<extremes::Check> checks = extremes::all_checks();
  if (words.empty()) return checks;
  std::erase_if(checks, [&](const extremes::Check& check) {
    return std::ranges::none_of(words, [&](const std::string& word) {
      return check.name.find(word) != std::string::npos ||
             check.group.find(word) != std::string::npos;
    });
  });
  if (checks.empty())
    throw InputError(fmt::format("--only {}: no row has that in its name, nor in that of its group",
                                 fmt::join(words, ",")));
  return checks;
}

/// Failures are told, and no reason to stop: the next row may be written again.
void keep(const std::string& file, const extremes::Table& so_far) {
  try {
    write_text(file, report::extremes_json(so_far).dump(1) + '\n');
  } catch (const InputError& error) {
    say("warning: {}\n", error.what());
  }
}

ExitCode run_extremes(const ExtremesOptions& o) {
  check_outputs({}, {o.json, o.html});
  const std::vector<extremes::Check> checks = chosen(o.only);
  KernelBackend backend(o.device, o.validate);
  catch_interrupts();
  const bool tells = o.json != "-";
  if (tells) put("{}, {}\n", backend.name(), backend.driver());
  // The whole table takes hours: its file holds at any time what has been found until then.
  std::error_code unknown;
  const bool keeps = tells && !o.json.empty() && !std::filesystem::is_other(o.json, unknown);
  std::string group;
  const extremes::Table table = extremes::measure(
      backend, checks, o.quick,
      [](const extremes::Check& /*check*/, double /*done*/) { return !was_interrupted(); },
      [&](const extremes::Table& so_far) {
        if (keeps) keep(o.json, so_far);
        if (!tells) return;
        const extremes::Row& row = so_far.rows.back();
        if (row.check.group != group) put("\n{}\n", row.check.group);
        group = row.check.group;
        put_text(report::text_of(row));
        std::fflush(stdout);
      });
  if (tells) put_text('\n' + report::summary_of(table));
  if (!o.json.empty()) write_text(o.json, report::extremes_json(table).dump(1) + '\n');
  if (!o.html.empty()) report::write_extremes_page(o.html, table);
  const std::vector<std::string> messages = backend.validation_messages();
  for (const std::string& message : messages) say("facet: validation: {}\n", message);
  if (!table.complete) return ExitCode::interrupted;
  const bool fails = std::ranges::any_of(table.rows, &extremes::Row::fails);
  return fails || !messages.empty() ? ExitCode::check_failed : ExitCode::done;
}

}  // namespace

void add_extremes_command(CommandLine& line) {
  const auto options = std::make_shared<ExtremesOptions>();
  ExtremesOptions& o = *options;
  Command command = line.add(
      "extremes",
      "Measure the worst cases of facet's numbers on a device: its arithmetic first, then every "
      "function over its whole range; exits 1 where a row neither holds nor is argued");
  add_device_option(command, o.device);
  command.flag("--quick", o.quick,
               "A sample of the inputs, ends of ranges included: less than two minutes instead of "
               "up to two hours");
  command.list("--only", o.only, "Rows whose name, or that of their group, contains one of these");
  command.text("--html", o.html, "Write the table as a page to this file");
  add_json_option(command, o.json);
  command.flag("--validate", o.validate, "Run with Vulkan's validation layers");
  command.action([options] { return run_extremes(*options); });
}

}  // namespace facet::cli
