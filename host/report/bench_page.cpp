#include "report/bench_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/yardstick.h"
#include "core/parallel.h"
#include "core/text.h"
#include "core/text_file.h"
#include "report/html.h"
#include "report/pages/page_text.h"
#include "version.h"

namespace facet::report {

namespace {

std::string cell(const std::string& text) {
  return "<td class=\"number\">" + escape_html(text) + "</td>";
}

std::string figure_cell(const bench::Figure& f, double scale = 1) {
  return cell(figure_text(f, scale));
}

/// A table of rows that are made already.
std::string table(const std::vector<std::string>& heads, const std::string& rows) {
  std::string html = "<div class=\"wide\"><table><thead><tr>";
  for (const std::string& head : heads) html += "<th scope=\"col\">" + escape_html(head) + "</th>";
  return html + "</tr></thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

class BenchPage {
 public:
  explicit BenchPage(const BenchReport& report) : report_(report) {
    for (const bench::TraversalResult& r : report_.traversal) {
      results_.push_back(&r);
      if (r.mesh.starts_with("generated-")) meshes_.push_back(&r);
    }
    std::ranges::stable_sort(meshes_, {}, &bench::TraversalResult::triangles);
  }

  [[nodiscard]] std::string html() const {
    const std::string name = bench::yardstick_name();
    return fill_template(page_text::bench_html,
                         {{"style", std::string(page_text::page_css)},
                          {"device", escape_html(report_.device)},
                          {"driver", escape_html(report_.driver)},
                          {"threads", fmt::format("{}", thread_count())},
                          {"yardstick", name.empty() ? "" : escape_html(", beside " + name)},
                          {"version", FACET_VERSION},
                          {"sections", rays() + trees() + renders() + growth()}});
  }

 private:
  [[nodiscard]] std::string rays() const {
    if (results_.empty()) return "";
    std::string plots;
    for (const char* kind : {"camera", "diffuse", "shadow"}) plots += rays_chart(kind);
    std::string rows;
    for (const bench::TraversalResult* r : results_) {
      for (const bench::TraversalRow& row : r->rows) rows += ray_row(*r, row);
    }
    return "<section><h2>Rays</h2><div class=\"charts\">\n" + plots + "</div>\n" +
           table({"mesh", "rays", "facet, M/s", "single rays, M/s", "packets of 8, M/s",
                  "facet / single", "equal hits"},
                 rows) +
           "</section>\n";
  }

  [[nodiscard]] std::string rays_chart(const std::string& kind) const {
    Line facet{"facet", {}};
    Line single{"single rays", {}};
    Line packets{"packets", {}};
    for (const bench::TraversalResult* r : meshes_) {
      for (const bench::TraversalRow& row : r->rows) {
        if (row.kind != kind) continue;
        const auto x = static_cast<double>(r->triangles);
        facet.points.emplace_back(x, row.facet.median);
        if (row.single) single.points.emplace_back(x, row.single->median);
        if (row.packets) packets.points.emplace_back(x, row.packets->median);
      }
    }
    if (facet.points.empty()) return "";
    LineChart chart{"Million " + kind + " rays a second", "triangles", "M rays/s", {facet}};
    if (!single.points.empty()) chart.lines.insert(chart.lines.end(), {single, packets});
    return svg_lines(chart);
  }

  [[nodiscard]] static std::string ray_row(const bench::TraversalResult& r,
                                           const bench::TraversalRow& row) {
    std::string html =
        fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td>", escape_html(r.mesh), row.kind);
    html += figure_cell(row.facet);
    if (!row.single) return html + "<td></td><td></td><td></td><td></td></tr>\n";
    return html + figure_cell(*row.single) + figure_cell(*row.packets) +
           cell(fmt::format("{:.2f}", row.ratio())) + cell(fmt::format("{:.6f}", row.equal_hits)) +
           "</tr>\n";
  }

  [[nodiscard]] std::string trees() const {
    if (results_.empty()) return "";
    Line own{"facet", {}};
    Line other{bench::yardstick_name(), {}};
    std::string rows;
    for (const bench::TraversalResult* r : meshes_) {
      const auto x = static_cast<double>(r->triangles);
      own.points.emplace_back(x, r->build.seconds.median);
      if (r->build.yardstick_seconds)
        other.points.emplace_back(x, r->build.yardstick_seconds->median);
    }
    for (const bench::TraversalResult* r : results_) {
      rows += fmt::format("<tr><th scope=\"row\">{}</th>", escape_html(r->mesh)) +
              cell(fmt::format("{}", r->triangles)) + cell(seconds_text(r->build.seconds)) +
              cell(fmt::format("{:.1f}", bytes_a_triangle(r->build.bytes, *r))) +
              cell(fmt::format("{:.2f}", r->build.sah)) +
              cell(r->build.yardstick_seconds ? seconds_text(*r->build.yardstick_seconds) : "") +
              cell(r->build.yardstick_bytes
                       ? fmt::format("{:.1f}", bytes_a_triangle(*r->build.yardstick_bytes, *r))
                       : "") +
              "</tr>\n";
    }
    LineChart chart{"Seconds to build the BVH", "triangles", "s", {own}};
    if (!other.points.empty()) chart.lines.push_back(other);
    const std::string plot = meshes_.empty() ? "" : svg_lines(chart);
    return "<section><h2>Trees</h2><div class=\"charts\">\n" + plot + "</div>\n" +
           table({"mesh", "triangles", "build, s", "bytes a triangle", "SAH cost", "other build, s",
                  "other bytes"},
                 rows) +
           "</section>\n";
  }

  [[nodiscard]] std::string renders() const {
    if (report_.renders.empty()) return "";
    std::vector<std::string> heads{"scene",        "integrator",   "samples a pixel",
                                   "M samples/s",  "M rays/s",     "to start, s",
                                   "compiling, s", "instructions", "on the device"};
    for (const std::string_view stage : stage_names) heads.emplace_back(std::string(stage) + ", %");
    std::string rows;
    for (const bench::RenderRow& r : report_.renders) {
      rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td>", escape_html(r.scene),
                          escape_html(r.integrator)) +
              cell(fmt::format("{}", r.samples_per_pixel)) +
              figure_cell(r.samples_per_second, 1e-6) +
              cell(fmt::format("{:.2f}", r.rays_per_second * 1e-6)) +
              cell(fmt::format("{:.2f}", r.startup_seconds)) +
              cell(fmt::format("{:.2f}", r.compile_seconds)) +
              cell(fmt::format("{}", r.kernel_instructions)) +
              cell(with_unit_prefix(static_cast<double>(r.device_bytes)) + "B");
      for (const double share : r.stage_shares) rows += cell(fmt::format("{:.0f}", 100 * share));
      rows += "</tr>\n";
    }
    return "<section><h2>Whole renders</h2>\n" + bars() + table(heads, rows) + "</section>\n";
  }

  [[nodiscard]] std::string growth() const {
    if (report_.growth.empty()) return "";
    std::string plots;
    std::string rows;
    for (const bench::GrowthSeries& series : report_.growth) {
      Line line{"facet", {}};
      for (const bench::GrowthPoint& p : series.points) {
        line.points.emplace_back(p.number, p.seconds.median);
        rows += "<tr><th scope=\"row\">" + escape_html(series.of) + "</th>" +
                cell(fmt::format("{:.0f}", p.number)) + cell(seconds_text(p.seconds)) + "</tr>\n";
      }
      plots += svg_lines({"Seconds of a frame", series.of, "s", {line}});
    }
    return "<section><h2>Growth</h2><div class=\"charts\">\n" + plots + "</div>\n" +
           table({"of", "number", "a frame, s"}, rows) + "</section>\n";
  }

  /// A bar a scene, as long as its samples per second, parted by the stages' shares.
  [[nodiscard]] std::string bars() const {
    constexpr double name_width = 200;
    constexpr double width = 760;
    constexpr double step = 26;
    double most = 0;
    for (const bench::RenderRow& r : report_.renders)
      most = std::max(most, r.samples_per_second.median);
    std::string svg;
    double y = 4;
    for (const bench::RenderRow& r : report_.renders) {
      const double length = (width - name_width - 70) * r.samples_per_second.median / most;
      svg += fmt::format("<text class=\"name\" x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>",
                         name_width - 8, y + 14, escape_html(r.scene));
      double x = name_width;
      for (std::size_t i = 0; i < r.stage_shares.size(); ++i) {
        const double part = length * r.stage_shares[i];
        svg += fmt::format(
            "<rect class=\"stage{}\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" "
            "height=\"18\"><title>{} {:.0f} "
            "%</title></rect>",
            i, x, y, part, stage_names[i], 100 * r.stage_shares[i]);
        x += part;
      }
      svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\">{:.2f}</text>", name_width + length + 6,
                         y + 14, r.samples_per_second.median * 1e-6);
      y += step;
    }
    std::string names;
    for (const std::string_view stage : stage_names)
      names += (names.empty() ? "" : ", ") + std::string(stage);
    return fmt::format(
        "<figure class=\"chart\"><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Samples a "
        "second\">{}</svg>"
        "<figcaption>Million samples a second; the parts of a bar are the shares of {}, from left "
        "to "
        "right.</figcaption>"
        "</figure>\n",
        width, y, svg, names);
  }

  const BenchReport& report_;
  std::vector<const bench::TraversalResult*> results_;
  std::vector<const bench::TraversalResult*>
      meshes_;  ///< those of one kind in many sizes, by size: what lines connect
};

}  // namespace

void write_bench_page(const std::string& path, const BenchReport& report) {
  write_text(path, BenchPage(report).html());
}

}  // namespace facet::report
