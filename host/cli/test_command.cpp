// facet test: Nori's statistical tests.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/reading_options.h"
#include "cli/render_options.h"
#include "core/print.h"
#include "core/text_file.h"
#include "door/open_backend.h"
#include "door/warnings.h"
#include "image/files.h"
#include "report/test_picture.h"
#include "report/test_report.h"
#include "scene/test_reader.h"

namespace facet::cli {

namespace {

struct TestOptions {
  std::vector<std::string> files;
  BackendChoice backend;
  LobeSampling sampling = LobeSampling::visible;
  std::uint32_t seed = 0;
  std::string pictures = ".";
  std::string junit;
  std::string json;
  bool quiet = false;
  ReadingRules reading;
};

class TestJob {
 public:
  explicit TestJob(const TestOptions& options) : options_(options) {}

  ExitCode run() {
    check_options();
    for (const std::string& file : options_.files) load(file);
    catch_interrupts();
    const std::unique_ptr<TestableBackend> backend = open_testable_backend(backend_options_);
    for (std::size_t i = 0; i < tests_.size() && !was_interrupted(); ++i)
      run_file(options_.files[i], tests_[i], *backend);
    const std::vector<std::string> faults = find_faults(*backend);
    for (const std::string& fault : faults) say("facet: {}\n", fault);
    write_reports(backend->name());
    if (was_interrupted()) return ExitCode::interrupted;
    return passed() == cases_.size() && faults.empty() ? ExitCode::done : ExitCode::check_failed;
  }

 private:
  void check_options() {
    backend_options_ = options_.backend.options();
    check_outputs({}, {options_.junit, options_.json});
    if (!std::filesystem::is_directory(options_.pictures))
      throw InputError(fmt::format("--pictures {}: no such folder", options_.pictures));
  }

  /// Beside the cases' own: validation messages, bounds that were hit; one line each.
  [[nodiscard]] std::vector<std::string> find_faults(const Backend& backend) const {
    std::vector<std::string> list;
    for (const std::string& message : backend.validation_messages())
      list.push_back("validation: " + message);
    if (std::any_of(cases_.begin(), cases_.end(),
                    [](const report::ReportedCase& c) { return c.result.bound_hits > 0; }))
      list.emplace_back("rays were stopped by the safety bound of traversal");
    return list;
  }

  void load(const std::string& file) {
    Diagnostics diagnostics(options_.reading);
    tests_.push_back(read_test(file, diagnostics));
    check_no_input_is_written({options_.junit, options_.json}, diagnostics.inputs());
    for (const TestedScene& tested : tests_.back().scenes)
      warn_about_render(tested.scene, resolve(tested.scene, {}), diagnostics);
    print_warnings(diagnostics);
  }

  void run_file(const std::string& file, const StatisticalTest& test, TestableBackend& backend) {
    if (!options_.quiet) say("{}: {} cases on {}\n", file, test.case_count(), backend.name());
    std::size_t number = 0;
    double start = seconds_since_start();
    nori::run_test(test, backend, options_.sampling, options_.seed,
                   [&](const nori::TestCase& result) {
                     const double end = seconds_since_start();
                     tell({file, result, picture_of(file, ++number, result), end - start});
                     start = end;
                     return !was_interrupted();
                   });
  }

  /// Writes the picture of a chi^2 test that failed; returns its path.
  std::string picture_of(const std::string& file, std::size_t number,
                         const nori::TestCase& result) {
    if (result.verdict.passed || !result.histogram) return "";
    const std::string stem = std::filesystem::path(file).stem().string();
    std::string name = fmt::format("{}-case{}.png", stem, number);
    for (int k = 2; !pictures_.insert(name).second; ++k)
      name = fmt::format("{}-case{}-{}.png", stem, number, k);
    const std::filesystem::path path = std::filesystem::path(options_.pictures) / name;
    report::write_histogram_picture(path, *result.histogram);
    return path.lexically_normal().string();
  }

  void tell(report::ReportedCase reported) {
    cases_.push_back(std::move(reported));
    if (options_.json == "-") return;
    const report::ReportedCase& last = cases_.back();
    put("{}{}\n", report::case_line(last),
        last.picture.empty() ? "" : "; histograms in " + last.picture);
    std::fflush(stdout);
  }

  [[nodiscard]] std::size_t passed() const {
    return static_cast<std::size_t>(
        std::count_if(cases_.begin(), cases_.end(),
                      [](const report::ReportedCase& c) { return c.result.verdict.passed; }));
  }

  void write_reports(const std::string& backend) const {
    if (options_.json != "-") put("{} of {} passed\n", passed(), cases_.size());
    if (!options_.junit.empty()) write_text(options_.junit, report::test_junit(cases_));
    if (!options_.json.empty())
      write_text(options_.json, report::test_json(cases_, backend, options_.seed) + '\n');
  }

  const TestOptions& options_;
  BackendOptions backend_options_;
  std::vector<StatisticalTest> tests_;
  std::vector<report::ReportedCase> cases_;
  std::set<std::string> pictures_;
};

}  // namespace

void add_test_command(CommandLine& line) {
  const auto options = std::make_shared<TestOptions>();
  TestOptions& o = *options;
  Command command = line.add("test",
                             "Run Nori's statistical tests (<test type=\"ttest\">, <test "
                             "type=\"chi2test\">); one line a case, exits 1 where one fails");
  command.arguments("files", o.files, "Test files (XML)");
  add_backend_options(command, o.backend);
  add_sampling_option(command, o.sampling, false);
  add_seed_option(command, o.seed);
  command.text("--pictures", o.pictures,
               "Folder for the pictures of failed chi^2 tests: histograms observed, expected, and "
               "their difference (red: too many, blue: too few)");
  command.text("--junit", o.junit, "Write a report in JUnit's XML to this file");
  add_report_options(command, o.json, o.quiet);
  add_reading_options(command, o.reading);
  command.action([options] { return TestJob(*options).run(); });
}

}  // namespace facet::cli
