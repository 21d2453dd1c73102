#include "cli/render_report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "core/print.h"
#include "core/text.h"
#include "image/record.h"

namespace facet::cli {

namespace {

/// After a colon, where there was a goal.
std::string why_it_stopped(const RenderOutcome& o) {
  if (o.record.stopped_by == StoppedBy::error)
    return fmt::format(": the {:g} % that were asked for", 100 * *o.error_goal);
  if (o.record.stopped_by == StoppedBy::time) return ": the time was over";
  return "";
}

double per_second(const RenderStatistics& s, std::uint64_t count) {
  return s.render_seconds > 0 ? static_cast<double>(count) / s.render_seconds : 0;
}

std::uint64_t host_peak_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

nlohmann::ordered_json json_of(const RenderRecord& record) {
  nlohmann::ordered_json json;
  for (const RecordField& field : record_fields()) {
    const auto text = field.json != nullptr ? field.read(record) : std::nullopt;
    if (!text || std::string_view(field.json) == "scene") continue;
    json[field.json] =
        field.numeric ? nlohmann::ordered_json::parse(*text) : nlohmann::ordered_json(*text);
  }
  return json;
}

std::string make_json_report(const RenderOutcome& o) {
  const RenderStatistics& s = o.statistics;
  nlohmann::ordered_json json = {{"scene", o.scene}};
  json.update(json_of(o.record));
  json.update({
      {"width", o.image.width()},
      {"height", o.image.height()},
      {"triangles", o.triangles},
      {"emitters", o.emitters},
      {"features", s.features},
      {"seconds",
       {{"load", o.load_seconds},
        {"bvh", s.bvh_seconds},
        {"compile", s.compile_seconds},
        {"render", s.render_seconds},
        {"write", o.write_seconds},
        {"total", seconds_since_start()}}},
      {"rays", {{"closest", s.closest_rays}, {"any", s.any_rays}}},
      {"samples_per_second", per_second(s, s.samples)},
      {"rays_per_second", per_second(s, s.closest_rays + s.any_rays)},
      {"error_estimate", json_of(o.error)},
      {"heavy_tails", json_of(o.heavy_tails)},
      {"bad_samples", s.bad_samples},
      {"bound_hits", s.bound_hits},
      {"memory", {{"device_bytes", s.device_bytes}, {"host_peak_bytes", host_peak_bytes()}}},
      {"output", o.files},
  });
  if (o.checkpoints)
    json["checkpoints"] = {{"written", o.checkpoints->written},
                           {"seconds", o.checkpoints->seconds}};
  if (o.is_pixel) json["pixel"] = {o.image.at(0, 0, 0), o.image.at(0, 0, 1), o.image.at(0, 0, 2)};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void print_summary(const RenderOutcome& o) {
  const RenderStatistics& s = o.statistics;
  say("{}: {}, {} triangles, {}x{} pixels, {} samples each{}{}\n", o.scene, o.record.integrator,
      o.triangles, o.image.width(), o.image.height(), o.record.samples.count(),
      o.record.adaptive ? " on average" : "", o.interrupted ? " (interrupted)" : "");
  say("{:.2f} s on {}: {}samples/s, {}rays/s; {:.2f} s in all\n", s.render_seconds, o.record.device,
      with_unit_prefix(per_second(s, s.samples)) + " ",
      with_unit_prefix(per_second(s, s.closest_rays + s.any_rays)) + " ", seconds_since_start());
  if (o.error.relmse > 0)
    say("estimated error {:.2g} %, at most {:.2g} % with 95 % confidence{}\n",
        100 * o.error.relative(), 100 * o.error.relative_upper(0.95), why_it_stopped(o));
  if (!o.files.empty()) say("wrote {}\n", fmt::join(o.files, " and "));
}

void print_failings(const RenderStatistics& s) {
  if (s.bad_samples > 0) {
    say("warning: {} samples were dropped: NaN, infinite or negative\n", s.bad_samples);
  }
  if (s.bound_hits > 0) {
    say("warning: {} rays were stopped by the safety bound of traversal; the image is wrong "
        "there\n",
        s.bound_hits);
  }
}

void warn_about_heavy_tails(const HeavyTails& tails) {
  if (!tails.dominate()) return;
  std::vector<std::string> worst;
  for (std::size_t i = 0; i < std::min<std::size_t>(tails.worst.size(), 3); ++i)
    worst.push_back(fmt::format("({}, {})", tails.worst[i][0], tails.worst[i][1]));
  say("warning: the error is larger than its estimate: {} pixels rest on fewer than {:g} of their "
      "{} "
      "samples, and carry {:.0f} % of the variance, as {} do\n",
      tails.pixels, HeavyTails::few, tails.samples, std::floor(100 * tails.variance_share),
      fmt::join(worst, ", "));
}

void warn_about_goals(const RenderOutcome& o) {
  if (o.error_goal && o.error.relative_upper(0.95) > *o.error_goal && !o.interrupted)
    say("warning: the error of {:g} % that was asked for is not reached: {}\n", 100 * *o.error_goal,
        o.record.stopped_by == StoppedBy::time ? "the time was over"
                                               : "there are no more samples than --spp says");
  if (o.time_goal && seconds_since_start() > 1.05 * *o.time_goal)
    say("warning: {:g} s were not enough: starting, {} sample{} a pixel and writing took {:.2f} "
        "s\n",
        *o.time_goal, o.record.samples.count(), o.record.samples.count() == 1 ? "" : "s",
        seconds_since_start());
}

nlohmann::ordered_json json_of(const ErrorEstimate& estimate) {
  return {{"relmse", estimate.relmse},
          {"relative", estimate.relative()},
          {"relative_upper95", estimate.relative_upper(0.95)},
          {"replicates", estimate.replicates},
          {"probes", estimate.probes}};
}

nlohmann::ordered_json json_of(const HeavyTails& tails) {
  return {
      {"pixels", tails.pixels}, {"variance_share", tails.variance_share}, {"worst", tails.worst}};
}

}  // namespace facet::cli
