// facet test: Nori's statistical tests.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>

#include "cli/backend_options.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/test_backends.h"
#include "cli/test_picture.h"
#include "cli/test_report.h"
#include "cli/text_file.h"
#include "cli/warnings.h"
#include "core/print.h"
#include "image/files.h"
#include "scene/test_reader.h"

namespace facet::cli {

namespace {

struct TestOptions {
  std::vector<std::string> files;
  std::string backend = "vulkan";
  std::string precision;
  std::string device;
  std::string sampling = "visible";
  std::uint32_t seed = 0;
  std::string pictures = ".";
  std::string junit;
  std::string json;
  bool quiet = false;
  bool strict = false;
  bool validate = false;
};

class TestJob {
 public:
  explicit TestJob(const TestOptions& options) : options_(options) {}

  ExitCode run() {
    check_options();
    for (const std::string& file : options_.files) load(file);
    catch_interrupts();
    const std::unique_ptr<TestRunner> runner = make_runner();
    for (std::size_t i = 0; i < tests_.size() && !was_interrupted(); ++i)
      run_file(options_.files[i], tests_[i], *runner);
    const std::vector<std::string> faults = runner->faults();
    for (const std::string& fault : faults) say("facet: {}\n", fault);
    write_reports(runner->name());
    if (was_interrupted()) return ExitCode::interrupted;
    return passed() == cases_.size() && faults.empty() ? ExitCode::done : ExitCode::check_failed;
  }

 private:
  void check_options() const {
    check_backend_options(options_.backend, options_.precision, options_.device, options_.validate);
    check_outputs({}, {options_.junit, options_.json});
    if (!std::filesystem::is_directory(options_.pictures))
      throw InputError(fmt::format("--pictures {}: no such folder", options_.pictures));
  }

  [[nodiscard]] std::unique_ptr<TestRunner> make_runner() const {
    const LobeSampling sampling = options_.sampling == "ndf" ? LobeSampling::ndf : LobeSampling::visible;
    if (options_.backend == "reference") return make_reference_runner(options_.precision, sampling);
    return make_kernel_runner(options_.device, options_.validate, sampling);
  }

  void load(const std::string& file) {
    Diagnostics diagnostics(options_.strict);
    tests_.push_back(read_test(file, diagnostics));
    check_no_input_is_written({options_.junit, options_.json}, diagnostics.inputs());
    for (const TestedScene& tested : tests_.back().scenes) warn_about_scene(tested.scene, diagnostics);
    print_warnings(diagnostics);
  }

  void run_file(const std::string& file, const StatisticalTest& test, TestRunner& runner) {
    if (!options_.quiet) say("{}: {} cases on {}\n", file, test.case_count(), runner.name());
    std::size_t number = 0;
    double start = seconds_since_start();
    statistics::run_test(test, runner.backend(), options_.seed, [&](const statistics::TestCase& result) {
      const double end = seconds_since_start();
      tell({file, result, picture_of(file, ++number, result), end - start});
      start = end;
      return !was_interrupted();
    });
  }

  /// Writes the picture of a chi^2 test that failed; returns its path.
  std::string picture_of(const std::string& file, std::size_t number, const statistics::TestCase& result) {
    if (result.verdict.passed || !result.histogram) return "";
    const std::string stem = std::filesystem::path(file).stem().string();
    std::string name = fmt::format("{}-case{}.png", stem, number);
    for (int k = 2; !pictures_.insert(name).second; ++k)
      name = fmt::format("{}-case{}-{}.png", stem, number, k);
    const std::filesystem::path path = std::filesystem::path(options_.pictures) / name;
    write_histogram_picture(path, *result.histogram);
    return path.lexically_normal().string();
  }

  void tell(ReportedCase reported) {
    cases_.push_back(std::move(reported));
    if (options_.json == "-") return;
    const ReportedCase& last = cases_.back();
    put("{}{}\n", case_line(last), last.picture.empty() ? "" : "; histograms in " + last.picture);
    std::fflush(stdout);
  }

  [[nodiscard]] std::size_t passed() const {
    return static_cast<std::size_t>(std::count_if(
        cases_.begin(), cases_.end(), [](const ReportedCase& c) { return c.result.verdict.passed; }));
  }

  void write_reports(const std::string& backend) const {
    if (options_.json != "-") put("{} of {} passed\n", passed(), cases_.size());
    if (!options_.junit.empty()) write_text(options_.junit, junit_report(cases_));
    if (!options_.json.empty()) write_text(options_.json, json_report(cases_, backend, options_.seed) + '\n');
  }

  const TestOptions& options_;
  std::vector<StatisticalTest> tests_;
  std::vector<ReportedCase> cases_;
  std::set<std::string> pictures_;
};

}  // namespace

void add_test_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<TestOptions>();
  TestOptions& o = *options;
  CLI::App* command = app.add_subcommand("test",
                                         "Run Nori's statistical tests (<test type=\"ttest\">, <test "
                                         "type=\"chi2test\">); one line a case, exits "
                                         "1 where one fails");
  command->add_option("files", o.files, "Test files (XML)")->required();
  add_backend_options(*command, o.backend, o.precision, o.device, o.validate);
  command->add_option("--sampling", o.sampling, "How half vectors of rough lobes are sampled")
      ->check(CLI::IsMember({"ndf", "visible"}))
      ->capture_default_str();
  command->add_option("--seed", o.seed, "Seed of the random numbers")->capture_default_str();
  command
      ->add_option("--pictures", o.pictures,
                   "Folder for the pictures of failed chi^2 tests: histograms observed, expected, and their "
                   "difference (red: too many, blue: too few)")
      ->capture_default_str();
  command->add_option("--junit", o.junit, "Write a report in JUnit's XML to this file");
  command->add_option("--json", o.json, "Write a report to this file, - for standard output");
  command->add_flag("--quiet", o.quiet, "Nothing but errors and warnings on standard error");
  command->add_flag("--strict", o.strict, "Warnings are errors");
  command->callback([options, &action] { action = [options] { return TestJob(*options).run(); }; });
}

}  // namespace facet::cli
