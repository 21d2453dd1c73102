#include "cli/render_report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "core/print.h"
#include "core/text.h"
#include "scene/fingerprint.h"
#include "version.h"

namespace facet::cli {

namespace {

double per_second(const RenderStatistics& s, std::uint64_t count) {
  return s.render_seconds > 0 ? static_cast<double>(count) / s.render_seconds : 0;
}

std::uint32_t samples_per_pixel(const RenderSettings& settings) {
  return settings.end_sample - settings.first_sample;
}

std::uint64_t host_peak_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> make_metadata(const RenderOptions& options,
                                                               const RenderOutcome& o) {
  return {
      {"facet.version", FACET_VERSION},
      {"facet.scene", o.scene.file.filename().string()},
      {"facet.integrator", std::string(o.scene.integrator.type.name)},
      {"facet.sampler", std::string(name_of(o.scene.sampler))},
      {"facet.sampling", options.sampling},
      {"facet.samples", fmt::format("{}:{}", o.settings.first_sample, o.settings.end_sample)},
      {"facet.spp", fmt::format("{}", samples_per_pixel(o.settings))},
      {"facet.seed", fmt::format("{}", o.settings.seed)},
      {"facet.maxDepth", fmt::format("{}", o.scene.integrator.interaction_limit())},
      {"facet.heuristic", o.scene.integrator.heuristic == Heuristic::power ? "power" : "balance"},
      {"facet.emitterSelection", o.scene.emitter_selection == EmitterSelection::power ? "power" : "uniform"},
      {"facet.filter", describe(o.scene.camera.filter)},
      {"facet.fingerprint", fmt::format("{:016x}", fingerprint(o.scene))},
      {"facet.backend", options.backend},
      {"facet.precision", options.precision.empty() ? "float" : options.precision},
      {"facet.device", o.device},
      {"facet.driver", o.driver},
      {"facet.seconds", fmt::format("{:.3f}", o.statistics.render_seconds)},
      {"facet.complete", o.interrupted ? "no: interrupted" : "yes"},
  };
}

std::string make_json_report(const RenderOptions& options, const RenderOutcome& o) {
  const RenderStatistics& s = o.statistics;
  nlohmann::ordered_json json = {
      {"scene", options.scene},
      {"device", o.device},
      {"driver", o.driver},
      {"backend", options.backend},
      {"integrator", o.scene.integrator.type.name},
      {"sampler", name_of(o.scene.sampler)},
      {"width", o.image.width()},
      {"height", o.image.height()},
      {"spp", samples_per_pixel(o.settings)},
      {"seed", o.settings.seed},
      {"triangles", o.scene.triangle_count()},
      {"emitters", o.scene.emitters.size()},
      {"features", o.features},
      {"seconds",
       {{"load", o.load_seconds},
        {"bvh", o.bvh_seconds},
        {"compile", s.compile_seconds},
        {"render", s.render_seconds},
        {"write", o.write_seconds},
        {"total", seconds_since_start()}}},
      {"rays", {{"closest", s.closest_rays}, {"any", s.any_rays}}},
      {"samples_per_second", per_second(s, s.samples)},
      {"rays_per_second", per_second(s, s.closest_rays + s.any_rays)},
      {"error_estimate", {{"relmse", o.relmse}, {"relative", std::sqrt(o.relmse)}}},
      {"heavy_tails", json_of(o.heavy_tails)},
      {"bad_samples", s.bad_samples},
      {"bound_hits", s.bound_hits},
      {"memory", {{"device_bytes", s.device_bytes}, {"host_peak_bytes", host_peak_bytes()}}},
      {"output", o.files},
  };
  if (options.pixel) json["pixel"] = {o.image.at(0, 0, 0), o.image.at(0, 0, 1), o.image.at(0, 0, 2)};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void print_summary(const RenderOptions& options, const RenderOutcome& o) {
  const RenderStatistics& s = o.statistics;
  say("{}: {}, {} triangles, {}x{} pixels, {} samples each{}\n", options.scene, o.scene.integrator.type.name,
      o.scene.triangle_count(), o.image.width(), o.image.height(), samples_per_pixel(o.settings),
      o.interrupted ? " (interrupted)" : "");
  say("{:.2f} s on {}: {}samples/s, {}rays/s; {:.2f} s in all\n", s.render_seconds, o.device,
      with_unit_prefix(per_second(s, s.samples)) + " ",
      with_unit_prefix(per_second(s, s.closest_rays + s.any_rays)) + " ", seconds_since_start());
  if (!o.files.empty()) say("wrote {}\n", fmt::join(o.files, " and "));
}

void print_failings(const RenderStatistics& s) {
  if (s.bad_samples > 0) {
    say("warning: {} samples were dropped: NaN, infinite or negative\n", s.bad_samples);
  }
  if (s.bound_hits > 0) {
    say("warning: {} rays were stopped by the safety bound of traversal; the image is wrong there\n",
        s.bound_hits);
  }
}

void warn_about_heavy_tails(const HeavyTails& tails) {
  if (!tails.dominate()) return;
  std::vector<std::string> worst;
  for (std::size_t i = 0; i < std::min<std::size_t>(tails.worst.size(), 3); ++i)
    worst.push_back(fmt::format("({}, {})", tails.worst[i][0], tails.worst[i][1]));
  say("warning: the error is larger than its estimate: {} pixels rest on fewer than {:g} of their {} "
      "samples, and carry {:.0f} % of the variance, as {} do\n",
      tails.pixels, HeavyTails::few, tails.samples, std::floor(100 * tails.variance_share),
      fmt::join(worst, ", "));
}

nlohmann::ordered_json json_of(const HeavyTails& tails) {
  return {{"pixels", tails.pixels}, {"variance_share", tails.variance_share}, {"worst", tails.worst}};
}

}  // namespace facet::cli
