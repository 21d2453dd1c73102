#include "report/bench_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/yardstick.h"
#include "core/parallel.h"
#include "core/text.h"

namespace facet::report {

namespace {

using nlohmann::ordered_json;

std::string rate_text(const Figure& f) { return figure_text(f, 1, 6); }

ordered_json figure_json(const Figure& f) {
  return {{"median", f.median}, {"min", f.min}, {"max", f.max}};
}

ordered_json row_json(const bench::TraversalResult& result, const bench::TraversalRow& row) {
  ordered_json j{{"mesh", result.mesh},
                 {"triangles", result.triangles},
                 {"rays", row.kind},
                 {"count", row.rays},
                 {"facet", figure_json(row.facet)}};
  if (row.single) {
    j["embree1"] = figure_json(*row.single);
    j["embree8"] = figure_json(*row.packets);
    j["ratio_embree1"] = row.ratio();
    j["equal_hits"] = row.equal_hits;
  }
  return j;
}

ordered_json build_json(const bench::TraversalResult& r) {
  ordered_json j{{"mesh", r.mesh},
                 {"triangles", r.triangles},
                 {"facet_seconds", figure_json(r.build.seconds)},
                 {"facet_bytes", r.build.bytes},
                 {"facet_sah", r.build.sah}};
  if (r.build.yardstick_seconds) {
    j["embree_seconds"] = figure_json(*r.build.yardstick_seconds);
    j["ratio_seconds"] = r.build.seconds.median / r.build.yardstick_seconds->median;
    j["embree_bytes"] = *r.build.yardstick_bytes;
  }
  return j;
}

ordered_json render_json(const bench::RenderRow& r) {
  ordered_json stages;
  for (std::size_t i = 0; i < r.stage_shares.size(); ++i)
    stages[std::string(stage_names[i])] = r.stage_shares[i];
  return {{"scene", r.scene},
          {"integrator", r.integrator},
          {"spp", r.samples_per_pixel},
          {"samples_per_second", r.samples_per_second.median},
          {"samples_per_second_min", r.samples_per_second.min},
          {"samples_per_second_max", r.samples_per_second.max},
          {"rays_per_second", r.rays_per_second},
          {"compile_seconds", r.compile_seconds},
          {"startup_seconds", r.startup_seconds},
          {"kernel_instructions", r.kernel_instructions},
          {"device_bytes", r.device_bytes},
          {"stages", stages}};
}

ordered_json growth_json(const bench::GrowthSeries& series) {
  ordered_json points;
  for (const bench::GrowthPoint& p : series.points)
    points.push_back({{"number", p.number}, {"seconds", figure_json(p.seconds)}});
  return {{"of", series.of}, {"points", points}};
}

}  // namespace

std::string figure_text(const Figure& f, double scale, int width) {
  return fmt::format("{:{}.2f} ({:.2f} to {:.2f})", f.median * scale, width, f.min * scale,
                     f.max * scale);
}

std::string seconds_text(const Figure& f) {
  return fmt::format("{:.3f} ({:.3f} to {:.3f})", f.median, f.min, f.max);
}

double bytes_a_triangle(std::uint64_t bytes, const bench::TraversalResult& r) {
  return static_cast<double>(bytes) / static_cast<double>(r.triangles);
}

std::string text_of(const bench::TraversalResult& r) {
  std::string text = fmt::format(
      "{}: {} triangles; BVH in {} s, {:.1f} bytes a triangle, SAH cost {:.2f}", printable(r.mesh),
      r.triangles, seconds_text(r.build.seconds), bytes_a_triangle(r.build.bytes, r), r.build.sah);
  if (r.build.yardstick_seconds) {
    text += fmt::format("; {}: {} s, {:.1f} bytes", bench::yardstick_name(),
                        seconds_text(*r.build.yardstick_seconds),
                        bytes_a_triangle(*r.build.yardstick_bytes, r));
  }
  text += '\n';
  for (const bench::TraversalRow& row : r.rows) {
    text += fmt::format("  {:8}{:>8} rays  facet {} M/s", row.kind, row.rays, rate_text(row.facet));
    if (row.single) {
      text +=
          fmt::format("  single {}  packets {}  ratio {:.2f}  equal {:.6f}", rate_text(*row.single),
                      rate_text(*row.packets), row.ratio(), row.equal_hits);
    }
    text += '\n';
  }
  return text;
}

std::string text_of(const bench::RenderRow& r) {
  std::string text = fmt::format(
      "{}: {} at {} samples a pixel: {} M samples/s, {:.2f} M rays/s; {:.2f} s to "
      "start, {:.2f} s "
      "of them compiling {} instructions; {}B on the device\n ",
      printable(r.scene), r.integrator, r.samples_per_pixel,
      figure_text(r.samples_per_second, 1e-6), r.rays_per_second * 1e-6, r.startup_seconds,
      r.compile_seconds, r.kernel_instructions,
      with_unit_prefix(static_cast<double>(r.device_bytes)));
  for (std::size_t i = 0; i < r.stage_shares.size(); ++i)
    text += fmt::format(" {} {:.0f} %", stage_names[i], 100 * r.stage_shares[i]);
  return text + '\n';
}

std::string text_of(const bench::GrowthSeries& series) {
  std::string text = fmt::format("a frame's time by its {}:\n", series.of);
  for (const bench::GrowthPoint& p : series.points)
    text += fmt::format("  {:8.0f}  {} s\n", p.number, seconds_text(p.seconds));
  return text;
}

ordered_json bench_json(const BenchReport& report) {
  ordered_json j{{"device", report.device},
                 {"driver", report.driver},
                 {"threads", thread_count()},
                 {"yardstick", bench::yardstick_name()},
                 {"traversal", ordered_json::array()},
                 {"build", ordered_json::array()},
                 {"render", ordered_json::array()},
                 {"growth", ordered_json::array()}};
  for (const bench::TraversalResult& r : report.traversal) {
    for (const bench::TraversalRow& row : r.rows) j["traversal"].push_back(row_json(r, row));
    j["build"].push_back(build_json(r));
  }
  for (const bench::RenderRow& r : report.renders) j["render"].push_back(render_json(r));
  for (const bench::GrowthSeries& s : report.growth) j["growth"].push_back(growth_json(s));
  return j;
}

}  // namespace facet::report
