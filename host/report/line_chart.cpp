// Charts of lines as inline SVG, coloured by the page's style sheet.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "report/html.h"

namespace facet::report {

namespace {

constexpr double left = 56;
constexpr double right = 16;
constexpr double top = 34;
constexpr double bottom = 42;
constexpr double width = 480;
constexpr double height = 280;
constexpr std::array<const char*, 3> classes{"first", "second", "third"};

/// A logarithmic axis between two of 1, 2, 5, 10, 20, ...
class Axis {
 public:
  /// Holds values from least to greatest.
  Axis(double least, double greatest) : ticks_(make_ticks(least, greatest)) {}

  /// Numbers to write at it, the first and the last being its ends.
  [[nodiscard]] const std::vector<double>& ticks() const { return ticks_; }

  /// 0 to 1 from the first tick to the last.
  [[nodiscard]] double position(double v) const {
    return std::log(v / ticks_.front()) / std::log(ticks_.back() / ticks_.front());
  }

 private:
  static std::vector<double> make_ticks(double least, double greatest) {
    std::vector<double> all;
    const int first = static_cast<int>(std::floor(std::log10(least)));
    const int end = static_cast<int>(std::ceil(std::log10(greatest))) + 1;
    for (int decade = first; decade <= end; ++decade) {
      for (const double digit : {1.0, 2.0, 5.0}) all.push_back(digit * std::pow(10.0, decade));
    }
    const auto from = std::upper_bound(all.begin(), all.end(), least * 1.0001) - 1;
    auto to = std::lower_bound(all.begin(), all.end(), greatest * 0.9999);
    if (to == from) ++to;
    std::vector<double> ticks(from, to + 1);
    // Over many decades their first numbers will do.
    constexpr std::size_t most = 9;
    if (ticks.size() > most) {
      std::erase_if(ticks, [&](double t) {
        const double exponent = std::log10(t);
        return t != ticks.front() && t != ticks.back() &&
               std::abs(exponent - std::round(exponent)) > 0.01;
      });
    }
    return ticks;
  }

  std::vector<double> ticks_;
};

std::string number_text(double v) {
  if (v >= 1e6) return fmt::format("{:g}M", v / 1e6);
  if (v >= 1e3) return fmt::format("{:g}k", v / 1e3);
  return fmt::format("{:g}", v);
}

class Drawing {
 public:
  explicit Drawing(const LineChart& chart)
      : chart_(chart),
        x_(axis_of([](const auto& point) { return point.first; })),
        y_(axis_of([](const auto& point) { return point.second; })) {}

  [[nodiscard]] std::string figure() const {
    std::string svg = fmt::format(
        "<figure class=\"chart\"><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", width,
        height, escape_html(chart_.title));
    svg += axes();
    for (std::size_t i = 0; i < chart_.lines.size(); ++i) svg += line(i) + legend(i);
    return svg +
           fmt::format("</svg><figcaption>{}</figcaption></figure>\n", escape_html(chart_.title));
  }

 private:
  template <typename Coordinate>
  [[nodiscard]] Axis axis_of(const Coordinate& coordinate) const {
    double least = std::numeric_limits<double>::max();
    double greatest = 0;
    for (const Line& line : chart_.lines) {
      for (const auto& point : line.points) {
        least = std::min(least, coordinate(point));
        greatest = std::max(greatest, coordinate(point));
      }
    }
    return {least, greatest};
  }

  [[nodiscard]] double x_of(double v) const {
    return left + x_.position(v) * (width - left - right);
  }
  [[nodiscard]] double y_of(double v) const {
    return height - bottom - y_.position(v) * (height - top - bottom);
  }

  [[nodiscard]] std::string axes() const {
    std::string svg;
    for (const double t : y_.ticks()) {
      svg +=
          fmt::format("<line class=\"grid\" x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>",
                      left, width - right, y_of(t));
      svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", left - 6,
                         y_of(t) + 4, number_text(t));
    }
    for (const double t : x_.ticks()) {
      svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", x_of(t),
                         height - bottom + 16, number_text(t));
    }
    svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                       (left + width - right) / 2, height - 6, escape_html(chart_.x_axis));
    return svg + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>", width - right,
                             12, escape_html(chart_.y_axis));
  }

  [[nodiscard]] std::string line(std::size_t i) const {
    std::string path;
    std::string dots;
    for (const auto& [px, py] : chart_.lines[i].points) {
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x_of(px), y_of(py));
      dots += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"><title>{}: {:g} at {:g}</title></circle>",
          x_of(px), y_of(py), escape_html(chart_.lines[i].name), py, px);
    }
    return fmt::format(
        "<g class=\"lines\"><path class=\"{0}\" style=\"fill:none\" d=\"{1}\"/><g "
        "class=\"{0}\">{2}</g></g>",
        classes.at(i), path, dots);
  }

  [[nodiscard]] std::string legend(std::size_t i) const {
    const double x = left + 110 * static_cast<double>(i);
    return fmt::format(
        "<g class=\"lines\"><path class=\"{}\" d=\"M{} 24h22\"/></g><text class=\"name\" x=\"{}\" "
        "y=\"28\">{}</text>",
        classes.at(i), x, x + 28, escape_html(chart_.lines[i].name));
  }

  const LineChart& chart_;
  Axis x_;
  Axis y_;
};

}  // namespace

std::string svg_lines(const LineChart& chart) { return Drawing(chart).figure(); }

}  // namespace facet::report
