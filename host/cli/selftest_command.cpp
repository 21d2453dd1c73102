// facet selftest: whether a device that nobody has tried yet renders right, and how fast; the
// report is what a bug's author attaches.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>

#include "cli/backend_options.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/selftest_scenes.h"
#include "core/clock.h"
#include "core/parallel.h"
#include "core/print.h"
#include "core/text.h"
#include "core/text_file.h"
#include "extremes/extremes.h"
#include "parity/parity.h"
#include "report/extremes_report.h"
#include "statistics/hypothesis.h"
#include "version.h"

namespace facet::cli {

namespace {

/// What a check says: nothing where all is well.
struct Verdict {
  std::string found;                ///< a line, of figures
  std::vector<std::string> faults;  ///< a line each
};

struct SelftestOptions {
  std::string device;
  std::string report = "facet-selftest.txt";
  bool validate = false;
};

/// "Intel(R) Xeon(R) ..."
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name"))
      return std::string(trimmed(line.substr(line.find(':') + 1)));
  }
  return "unknown processor";
}

std::string system_text() {
  utsname system{};
  ::uname(&system);
  return fmt::format("{} {} {}, {}, {} threads", system.sysname, system.release, system.machine,
                     processor_name(), thread_count());
}

std::string device_text(const gpu::DeviceInfo& d) {
  return fmt::format("{}: {} ({}), {}, Vulkan {}, {}B of device memory, {}", d.index, d.name,
                     d.kind, d.driver, d.vulkan_version,
                     with_unit_prefix(static_cast<double>(d.memory_bytes)), suitability(d));
}

class Selftest {
 public:
  explicit Selftest(const SelftestOptions& options) : options_(options) {}

  ExitCode run() {
    check_outputs({}, {options_.report});
    tell(fmt::format("facet {} (built with {})", FACET_VERSION, FACET_COMPILER));
    tell(system_text());
    for (const gpu::DeviceInfo& device : gpu::list_devices()) tell(device_text(device));
    open_backend();
    tell(fmt::format("tested: {}, {}", backend_->name(), backend_->driver()));
    tell("");
    catch_interrupts();
    check("arithmetic", [&] { return arithmetic(); });
    check("furnace", [&] { return furnace(); });
    check("parity, metals", [&] { return parity(metals_scene()); });
    check("parity, paths", [&] { return parity(paths_scene()); });
    check("same bits again", [&] { return repetition(); });
    check("speed, metals", [&] { return speed(metals_scene()); });
    check("speed, paths", [&] { return speed(paths_scene()); });
    if (options_.validate) check("validation", [&] { return validation(); });
    tell("");
    tell(summary());
    keep();
    if (was_interrupted()) return ExitCode::interrupted;
    return failed_ == 0 ? ExitCode::done : ExitCode::check_failed;
  }

 private:
  /// What keeps a device from being opened is what its user has to report.
  void open_backend() {
    try {
      backend_.emplace(options_.device, options_.validate);
    } catch (const Error& error) {
      tell(fmt::format("FAILED  no device: {}", error.what()));
      keep();
      throw;
    }
  }

  void tell(const std::string& line) {
    const std::string shown = printable(line, line.size()) + '\n';
    put_text(shown);
    std::fflush(stdout);
    text_ += shown;
  }

  /// An error of the device is a fault like others: what comes after it may still tell something.
  void check(const char* name, const std::function<Verdict()>& measure) {
    if (was_interrupted()) return;
    const auto start = Clock::now();
    Verdict verdict;
    try {
      verdict = measure();
    } catch (const std::exception& error) {
      verdict.faults.emplace_back(error.what());
    }
    // Half of a check proves nothing.
    if (was_interrupted()) return;
    tell(fmt::format("{:<6}  {:<16}  {}{}({:.1f} s)", verdict.faults.empty() ? "holds" : "FAILED",
                     name, verdict.found, verdict.found.empty() ? "" : " ", seconds_since(start)));
    for (const std::string& fault : verdict.faults) tell("        " + fault);
    ++checks_;
    if (!verdict.faults.empty()) ++failed_;
  }

  /// What images that are the same in every bit rest on.
  Verdict arithmetic() {
    std::vector<extremes::Check> checks = extremes::arithmetic_checks();
    const extremes::Table table = extremes::measure(
        *backend_, checks, true, [](const auto&, double) { return !was_interrupted(); },
        [](const extremes::Table&) {});
    Verdict verdict{fmt::format("{} premises", table.rows.size()), {}};
    for (const extremes::Row& row : table.rows) {
      if (row.fails()) verdict.faults.emplace_back(trimmed(report::text_of(row)));
    }
    return verdict;
  }

  /// The image's mean against the closed form, in one channel: all are equal.
  Verdict furnace() {
    constexpr double albedo = 0.75;
    constexpr double expected = 1 / (1 - albedo);
    constexpr double significance = 1e-6;
    const Film film =
        backend_->render(furnace_scene(albedo), {.variance = true, .progress = go_on()});
    double sum = 0;
    double squares = 0;
    double samples = 0;
    for (const PixelSums& pixel : film.pixels) {
      sum += pixel.values[1];
      squares += pixel.squares[1];
      samples += pixel.samples;
    }
    const double mean = sum / samples;
    const double error = std::sqrt(std::max(squares / samples - mean * mean, 0.0) / samples);
    const double largest = statistics::two_sided_normal_quantile(significance) * error;
    Verdict verdict{fmt::format("mean {:.5f}, {:.5f} expected", mean, expected), {}};
    if (!(std::abs(mean - expected) <= largest))
      verdict.faults.push_back(fmt::format(
          "off by more than {:.2g}, which chance does once in {:.0g}", largest, 1 / significance));
    return verdict;
  }

  Verdict parity(const ScenePtr& scene) {
    RenderSettings settings = resolve(*scene, {});
    settings.variance = true;
    const std::unique_ptr<Rendering> rendering = backend_->start(scene, settings);
    const parity::ParityReport report =
        parity::check_parity(*scene, settings, parity::tolerance_on(backend_->device().is_cpu()),
                             *rendering, [](double) { return !was_interrupted(); });
    return {fmt::format("{} samples, {:.2f} % equal in all bits, {} diverged, {} unexplained",
                        report.samples,
                        100.0 * static_cast<double>(report.identical) /
                            static_cast<double>(std::max<std::uint64_t>(report.samples, 1)),
                        report.diverged.size(), report.unexplained()),
            report.failings()};
  }

  /// A render twice, and a part of it alone.
  Verdict repetition() {
    const ScenePtr scene = paths_scene();
    const Film whole = backend_->render(scene, {.progress = go_on()});
    const Film again = backend_->render(scene, {.progress = go_on()});
    const Crop crop{40, 30, 90, 100};
    const Film cropped = backend_->render(scene, {.crop = crop, .progress = go_on()});
    Verdict verdict;
    const auto differing = [&](const Film& other, int x0, int y0) {
      std::size_t count = 0;
      for (int y = 0; y < other.height; ++y) {
        for (int x = 0; x < other.width; ++x)
          count += other.at(x, y) == whole.at(x + x0, y + y0) ? 0U : 1U;
      }
      return count;
    };
    if (const auto count = differing(again, 0, 0); count > 0)
      verdict.faults.push_back(fmt::format("{} pixels differ when rendered again", count));
    if (const auto count = differing(cropped, crop.x0, crop.y0); count > 0)
      verdict.faults.push_back(fmt::format("{} pixels differ when rendered as a crop", count));
    return verdict;
  }

  /// How fast it is, in renders of some seconds; nothing that can fail.
  Verdict speed(const ScenePtr& scene) {
    constexpr double seconds = 5;
    const std::unique_ptr<Rendering> rendering =
        backend_->start(scene, RenderRequest{.samples = 1 << 20,
                                             .size = ImageSize{640, 480},
                                             .deadline = Clock::now() + duration_of(seconds)});
    rendering->run(go_on());
    const RenderStatistics& s = rendering->statistics();
    const double time = std::max(s.render_seconds, 1e-9);
    Verdict verdict{fmt::format("{:.4g} Mrays/s, {:.4g} Msamples/s; kernels compiled in {:.2f} s",
                                1e-6 * static_cast<double>(s.closest_rays + s.any_rays) / time,
                                1e-6 * static_cast<double>(s.samples) / time, s.compile_seconds),
                    {}};
    if (s.bound_hits > 0)
      verdict.faults.push_back(
          fmt::format("{} rays were stopped by the safety bound of traversal", s.bound_hits));
    if (s.bad_samples > 0) verdict.faults.push_back(fmt::format("{} bad samples", s.bad_samples));
    return verdict;
  }

  Verdict validation() { return {"", backend_->validation_messages()}; }

  static ProgressCallback go_on() {
    return [](double, const RenderStatistics&) { return !was_interrupted(); };
  }

  [[nodiscard]] std::string summary() const {
    if (was_interrupted()) return "interrupted: this is what was tested until then";
    if (failed_ == 0) return fmt::format("all {} checks hold", checks_);
    return fmt::format("{} of {} checks FAILED; facet extremes --quick tells more of the device",
                       failed_, checks_);
  }

  void keep() {
    if (options_.report.empty()) return;
    write_text(options_.report, text_);
    put("report: {} (please attach it where you tell of a fault)\n", options_.report);
  }

  const SelftestOptions& options_;
  std::optional<KernelBackend> backend_;
  std::string text_;
  int checks_ = 0;
  int failed_ = 0;
};

}  // namespace

void add_selftest_command(CommandLine& line) {
  const auto options = std::make_shared<SelftestOptions>();
  Command command = line.add(
      "selftest",
      "Try a device in less than two minutes: its arithmetic, a furnace, parity of two scenes, "
      "the same bits twice, speed; exits 1 where a check does not hold");
  add_device_option(command, options->device);
  command.text("-o,--output", options->report,
               "Also write the report to this file; empty: to none");
  command.flag("--validate", options->validate, "Run with Vulkan's validation layers");
  command.action([options] { return Selftest(*options).run(); });
}

}  // namespace facet::cli
