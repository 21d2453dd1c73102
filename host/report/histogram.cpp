// Histograms as inline SVG, coloured by the page's style sheet.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/html.h"

namespace facet::report {

namespace {

constexpr double left = 52;
constexpr double right = 8;
constexpr double top = 22;
constexpr double bottom = 40;
constexpr double width = 480;
constexpr double height = 220;
constexpr std::size_t bins = 60;

/// Counts values along one axis and draws them.
class Chart {
 public:
  Chart(const Histogram& histogram, std::span<const double> values)
      : h_(histogram), values_(values) {
    if (h_.logarithmic) {
      const Decades decades = decades_of(values);
      low_ = decades.first;
      high_ = decades.end;
    }
    for (const double v : values) count(v);
    largest_ = *std::max_element(counts_.begin(), counts_.end());
  }

  [[nodiscard]] std::string figure() const {
    std::string svg = fmt::format(
        "<figure class=\"chart\"><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Histogram: "
        "{}\">",
        width, height, escape_html(h_.title));
    svg += count_axis() + bars() + value_axis() + mark() + "</svg>";
    return svg + fmt::format("<figcaption>{}</figcaption></figure>",
                             escape_html(h_.title + "." + remarks()));
  }

 private:
  /// Where a value lies on the axis, 0 to 1.
  [[nodiscard]] double position(double v) const {
    return ((h_.logarithmic ? std::log10(v) : v) - low_) / (high_ - low_);
  }

  void count(double v) {
    if (!std::isfinite(v)) {
      ++(std::isnan(v) ? nan_ : infinite_);
    } else if (h_.logarithmic && v <= 0) {
      ++zero_;
    } else if (position(v) < 0) {
      ++below_;
    } else {
      const auto bin = static_cast<std::size_t>(position(v) * static_cast<double>(bins));
      ++counts_.at(std::min(bin, bins - 1));
    }
  }

  static double x_of(double position) { return left + position * (width - left - right); }
  [[nodiscard]] double y_of(double count) const {
    return height - bottom -
           count / std::max(1.0, static_cast<double>(largest_)) * (height - top - bottom);
  }

  [[nodiscard]] std::string bars() const {
    std::string svg;
    const double step = (width - left - right) / static_cast<double>(bins);
    for (std::size_t i = 0; i < bins; ++i) {
      if (counts_.at(i) == 0) continue;
      const double y = y_of(static_cast<double>(counts_.at(i)));
      svg += fmt::format(
          "<rect class=\"bar\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/>",
          left + static_cast<double>(i) * step, y, step - 0.8, height - bottom - y);
    }
    return svg;
  }

  [[nodiscard]] std::string count_axis() const {
    std::string svg;
    for (const double share : {0.0, 0.5, 1.0}) {
      const double count = std::round(share * static_cast<double>(largest_));
      const double y = y_of(count);
      svg +=
          fmt::format("<line class=\"grid\" x1=\"{0}\" x2=\"{1}\" y1=\"{2:.2f}\" y2=\"{2:.2f}\"/>",
                      left, width - right, y);
      svg += fmt::format("<text x=\"{}\" y=\"{:.2f}\" text-anchor=\"end\">{:.0f}</text>", left - 6,
                         y + 4, count);
    }
    return svg;
  }

  [[nodiscard]] std::string value_axis() const {
    std::string svg;
    const int ticks = h_.logarithmic ? static_cast<int>(std::lround(high_ - low_)) : 5;
    for (int i = 0; i <= ticks; ++i) {
      const double share = static_cast<double>(i) / ticks;
      const std::string label = h_.logarithmic
                                    ? fmt::format("{:g}", std::pow(10, std::lround(low_) + i))
                                    : fmt::format("{:g}", share);
      svg += fmt::format("<text x=\"{:.2f}\" y=\"{}\" text-anchor=\"{}\">{}</text>", x_of(share),
                         height - bottom + 16, i == ticks ? "end" : "middle", label);
    }
    return svg + fmt::format(
                     "<text x=\"{:.2f}\" y=\"{}\" text-anchor=\"middle\" class=\"axis\">{}</text>",
                     x_of(0.5), height - 6, escape_html(h_.axis));
  }

  [[nodiscard]] std::string mark() const {
    const double p = h_.mark > 0 && std::isfinite(h_.mark) ? position(h_.mark) : -1;
    if (p < 0 || p > 1) return "";
    return fmt::format(
        "<line class=\"mark\" x1=\"{0:.2f}\" x2=\"{0:.2f}\" y1=\"{1}\" y2=\"{2}\"/>"
        "<text class=\"mark\" x=\"{3:.2f}\" y=\"{4}\" text-anchor=\"{5}\">{6} {7:.3g}</text>",
        x_of(p), top - 4, height - bottom, x_of(p) + (p > 0.7 ? -4 : 4), top - 8,
        p > 0.7 ? "end" : "start", escape_html(h_.mark_name), h_.mark);
  }

  /// What the bars do not show.
  [[nodiscard]] std::string remarks() const {
    std::string text;
    const auto say = [&](std::size_t count, const std::string& what) {
      if (count > 0) text += fmt::format(" {} of {} pixels {}.", count, values_.size(), what);
    };
    say(zero_, "have none");
    say(below_, "lie below the axis");
    say(infinite_, "have an infinite one");
    say(nan_, "are not finite");
    return text;
  }

  const Histogram& h_;
  std::span<const double> values_;
  double low_ = 0;
  double high_ = 1;
  std::array<std::size_t, bins> counts_{};
  std::size_t largest_ = 0;
  std::size_t zero_ = 0;
  std::size_t below_ = 0;
  std::size_t infinite_ = 0;
  std::size_t nan_ = 0;
};

}  // namespace

Decades decades_of(std::span<const double> values) {
  constexpr int most_decades = 6;
  double smallest = INFINITY;
  double largest = 0;
  for (const double v : values) {
    if (!(v > 0) || std::isinf(v)) continue;
    smallest = std::min(smallest, v);
    largest = std::max(largest, v);
  }
  if (largest == 0) return {};
  const int end = static_cast<int>(std::floor(std::log10(largest))) + 1;
  const int first = static_cast<int>(std::floor(std::log10(smallest)));
  return {std::max(first, end - most_decades), end};
}

std::string svg_histogram(const Histogram& histogram, std::span<const double> values) {
  return Chart(histogram, values).figure();
}

}  // namespace facet::report
