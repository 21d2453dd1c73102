#pragma once
// Pieces of self-contained HTML pages.
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace facet::report {

/// Text for an element or a quoted attribute. Bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string escape_html(std::string_view text);

[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

/// Replaces each {{name}} by its value, which is not searched again. Throws std::out_of_range for a
/// name without a value.
[[nodiscard]] std::string fill_template(std::string_view text,
                                        const std::map<std::string, std::string>& values);

/// Decades that hold the positive finite values, at most six below the largest; {0, 1} where there
/// are none.
struct Decades {
  int first = 0;  ///< from 10^first
  int end = 1;    ///< to 10^end
};
[[nodiscard]] Decades decades_of(std::span<const double> values);

struct Histogram {
  std::string title;
  std::string axis;          ///< what the values are
  bool logarithmic = false;  ///< over decades_of the values, else over [0, 1]
  double mark = 0;           ///< a value to mark, where it lies on the axis
  std::string mark_name;
};

/// A figure with an inline SVG; values that the axis cannot hold (0 on a logarithmic one, infinite,
/// NaN) are counted beneath it.
[[nodiscard]] std::string svg_histogram(const Histogram& histogram, std::span<const double> values);

/// One line of a chart.
struct Line {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< positive
};

struct LineChart {
  std::string title;
  std::string x_axis;
  std::string y_axis;
  std::vector<Line> lines;  ///< at most three, and some point
};

/// A figure with an inline SVG, both axes logarithmic.
[[nodiscard]] std::string svg_lines(const LineChart& chart);

}  // namespace facet::report
