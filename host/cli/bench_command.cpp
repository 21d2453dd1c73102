// facet bench: rays and samples per second.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/mesh.h"
#include "bench/yardstick.h"
#include "cli/backend_options.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/reading_options.h"
#include "core/print.h"
#include "core/text_file.h"
#include "image/files.h"
#include "report/bench_page.h"
#include "report/bench_report.h"
#include "scene/reader.h"

namespace facet::cli {

namespace {

struct BenchOptions {
  std::vector<std::string> scenes;
  std::vector<std::string> meshes;
  std::uint32_t samples_per_pixel = bench::WholeRenderOptions{}.samples_per_pixel;
  std::string device;
  std::string json;
  std::string html;
  ReadingRules reading;
  bool growth = false;
  bool quick = false;
  bool with_everything = false;
  bench::TraversalOptions traversal;
};

const std::vector<std::string> default_meshes{"10k", "70k", "1M"};
/// Of --quick.
const std::vector<std::string> quick_meshes{"10k"};
constexpr std::uint32_t quick_rays = 1U << 14U;
constexpr int quick_repeats = 3;
constexpr std::uint32_t quick_samples = 4;

/// "70k" is 70000.
std::size_t parse_count(const std::string& text) {
  std::size_t end = 0;
  double value = 0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = text.size();
    value = 0;
  }
  const std::string unit = text.substr(end);
  if (unit == "k") value *= 1e3;
  if (unit == "M") value *= 1e6;
  const bool known = unit.empty() || unit == "k" || unit == "M";
  if (!known || !(value >= 24 && value <= 3e7))
    throw InputError(fmt::format(
        "--mesh {}: wanted is a number of triangles from 24 to 30M, such as 70k", text));
  return static_cast<std::size_t>(std::llround(value));
}

class BenchJob {
 public:
  explicit BenchJob(const BenchOptions& options) : options_(options), device_(options.device) {
    report_.device = device_.info().name;
    report_.driver = device_.info().driver;
  }

  ExitCode run() {
    catch_interrupts();
    check_outputs({}, {options_.json, options_.html});
    std::vector<std::size_t> meshes;
    for (const std::string& text : wanted_meshes()) meshes.push_back(parse_count(text));
    std::vector<Scene> scenes;
    for (const std::string& file : options_.scenes) scenes.push_back(load(file));
    tell(fmt::format("{}, {}; {}\n", report_.device, report_.driver,
                     bench::yardstick_name().empty()
                         ? "no Embree to compare with (built without libembree-dev)"
                         : "beside " + bench::yardstick_name()));
    for (const std::size_t triangles : meshes) {
      if (was_interrupted()) break;
      trace(bench::generated_name(triangles), bench::generate_scene(triangles));
    }
    for (std::size_t i = 0; i < scenes.size() && !was_interrupted(); ++i) {
      const std::string name = std::filesystem::path(options_.scenes[i]).stem().string();
      trace(name, scenes[i]);
      render(name, scenes[i]);
    }
    if (options_.growth && !was_interrupted()) grow();
    if (!options_.json.empty())
      write_text(options_.json, report::bench_json(report_).dump(1) + '\n');
    if (!options_.html.empty()) report::write_bench_page(options_.html, report_);
    return was_interrupted() ? ExitCode::interrupted : ExitCode::done;
  }

 private:
  [[nodiscard]] const std::vector<std::string>& wanted_meshes() const {
    const bool is_default = options_.meshes.empty() && options_.scenes.empty() && !options_.growth;
    if (!is_default) return options_.meshes;
    return options_.quick ? quick_meshes : default_meshes;
  }

  Scene load(const std::string& file) {
    Diagnostics diagnostics(options_.reading);
    Scene scene = read_scene(file, diagnostics);
    check_no_input_is_written({options_.json, options_.html}, diagnostics.inputs());
    print_warnings(diagnostics);
    return scene;
  }

  void trace(const std::string& name, Scene scene) {
    if (scene.triangle_count() == 0) return;
    report_.traversal.push_back(
        bench::measure_traversal(device_, name, std::move(scene), options_.traversal));
    tell(report::text_of(report_.traversal.back()));
  }

  void render(const std::string& name, const Scene& scene) {
    for (const bench::RenderRow& row : bench::measure_render(
             device_, name, scene,
             {options_.samples_per_pixel, std::max(1, options_.traversal.repeats / 2),
              options_.with_everything})) {
      report_.renders.push_back(row);
      tell(report::text_of(row));
    }
  }

  void grow() {
    report_.growth = bench::measure_growth(device_, {options_.traversal.repeats, options_.quick},
                                           [] { return !was_interrupted(); });
    for (const bench::GrowthSeries& series : report_.growth) tell(report::text_of(series));
  }

  void tell(const std::string& text) const {
    if (options_.json == "-") return;
    put_text(text);
    std::fflush(stdout);
  }

  const BenchOptions& options_;
  gpu::Device device_;
  report::BenchReport report_;
};

/// What was asked for by name stays.
void make_quick(const Command& command, BenchOptions& o) {
  if (!command.is_given("--rays")) o.traversal.rays = quick_rays;
  if (!command.is_given("--repeats")) o.traversal.repeats = quick_repeats;
  if (!command.is_given("--spp")) o.samples_per_pixel = quick_samples;
}

}  // namespace

void add_bench_command(CommandLine& line) {
  const auto options = std::make_shared<BenchOptions>();
  BenchOptions& o = *options;
  Command command = line.add("bench",
                             "Measure rays and samples per second: of generated meshes, or of "
                             "scenes and meshes that are named");
  command.arguments("scenes", o.scenes,
                    "Scene files: rays through their meshes, then whole renders", false);
  command.list("--mesh", o.meshes,
               "Generated meshes by their number of triangles; without scenes: 10k,70k,1M");
  command.number("--rays", o.traversal.rays, 1U << 10U, 1U << 20U, "Rays from the camera, about");
  command.number("--repeats", o.traversal.repeats, 1, 1000,
                 "Timed runs of each, of building three at most; the median counts");
  command.number("--spp", o.samples_per_pixel, 1U, 1U << 20U, "Samples a pixel of whole renders");
  command.flag("--everything", o.with_everything,
               "Render scenes also with kernels that have every BSDF, emitter and texture in");
  command.flag("--growth", o.growth,
               "Measure how a frame's time grows with pixels, samples and emitters");
  command.flag("--quick", o.quick,
               fmt::format("A first look in seconds, with more scatter: --rays {} --repeats {} "
                           "--spp {}, each unless given; --mesh {} alone; growth in fewer and "
                           "smaller frames",
                           quick_rays, quick_repeats, quick_samples, quick_meshes.front()));
  add_device_option(command, o.device);
  add_reading_options(command, o.reading);
  add_json_option(command, o.json);
  command.text("--html", o.html, "Write a page with plots and tables to this file");
  command.action([options, command] {
    if (options->quick) make_quick(command, *options);
    return BenchJob(*options).run();
  });
}

}  // namespace facet::cli
