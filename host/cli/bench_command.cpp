// facet bench: rays and samples per second.
#include <fmt/format.h>

#include <cmath>

#include "bench/mesh.h"
#include "bench/traversal.h"
#include "bench/yardstick.h"
#include "cli/backend_options.h"
#include "cli/commands.h"
#include "cli/interrupt.h"

namespace facet::cli {

namespace {

struct BenchOptions {
  std::vector<std::string> scenes;
  std::vector<std::string> meshes{"10k", "70k", "1M"};
  std::string device;
  bench::TraversalOptions traversal;
};

/// "70k" is 70000.
std::size_t parse_count(const std::string& text) {
  std::size_t end = 0;
  double value = 0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = std::string::npos;
  }
  const std::string unit = end <= text.size() ? text.substr(end) : "?";
  const double factor = unit == "k" ? 1e3 : unit == "M" ? 1e6 : unit.empty() ? 1 : 0;
  value *= factor;
  if (!(value >= 24 && value <= 1e8))
    throw InputError(fmt::format("--mesh {}: a number of triangles from 24 to 100M, such as 70k", text));
  return static_cast<std::size_t>(std::llround(value));
}

std::string rate_text(const bench::Figure& f) {
  return fmt::format("{:6.2f} ({:.2f}-{:.2f})", f.median, f.min, f.max);
}

void print(const bench::TraversalResult& r) {
  fmt::print("{}: {} triangles, BVH in {:.3f} s, {:.1f} bytes a triangle, SAH cost {:.1f}", r.mesh,
             r.triangles, r.build.seconds,
             static_cast<double>(r.build.bytes) / static_cast<double>(r.triangles), r.build.sah);
  if (r.build.yardstick_seconds) {
    fmt::print("; {}: {:.3f} s, {:.1f} bytes", bench::yardstick_name(), *r.build.yardstick_seconds,
               static_cast<double>(*r.build.yardstick_bytes) / static_cast<double>(r.triangles));
  }
  fmt::print("\n");
  for (const bench::TraversalRow& row : r.rows) {
    fmt::print("  {:8} {:7} rays  facet {}", row.kind, row.rays, rate_text(row.facet));
    if (row.single)
      fmt::print("  single {}  packets {}  ratio {:.2f}  equal {:.6f}", rate_text(*row.single),
                 rate_text(*row.packets), row.ratio(), row.equal_hits);
    fmt::print("\n");
  }
  std::fflush(stdout);
}

ExitCode run_bench(const BenchOptions& options) {
  catch_interrupts();
  const gpu::Instance instance(false);
  gpu::Device device(instance, instance.choose(options.device));
  for (const std::string& text : options.meshes) {
    const std::size_t triangles = parse_count(text);
    print(bench::measure_traversal(device, bench::generated_name(triangles), bench::generate_scene(triangles),
                                   options.traversal));
    if (was_interrupted()) return ExitCode::interrupted;
  }
  return ExitCode::done;
}

}  // namespace

void add_bench_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<BenchOptions>();
  CLI::App* command = app.add_subcommand("bench", "Measure rays and samples per second");
  command->add_option("scenes", options->scenes, "Scene files to measure");
  command->add_option("--mesh", options->meshes, "Generated meshes of so many triangles: 10k,70k,1M")
      ->delimiter(',');
  command->add_option("--rays", options->traversal.rays, "Rays from the camera")
      ->check(CLI::Range(1024, 1 << 20))
      ->capture_default_str();
  command->add_option("--repeats", options->traversal.repeats, "Timed runs, whose median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_device_option(*command, options->device);
  command->callback([options, &action] { action = [options] { return run_bench(*options); }; });
}

}  // namespace facet::cli
