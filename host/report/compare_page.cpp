#include "report/compare_page.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/text_file.h"
#include "report/compare_report.h"
#include "report/html.h"
#include "report/pages/page_text.h"
#include "version.h"

namespace facet::report {

namespace {

constexpr std::size_t most_pixels = 1U << 23U;

/// Values in the order of the image's rows, a code each: 0 to 254 along the scale, 255 where there
/// is none.
struct ErrorMap {
  std::string name;
  std::string note;
  bool logarithmic = false;
  double low = 0;
  double high = 1;
  std::vector<double> values;

  [[nodiscard]] std::uint8_t code(double v) const {
    if (std::isnan(v)) return 255;
    if (!logarithmic) return static_cast<std::uint8_t>(std::lround(254 * std::clamp(v, 0.0, 1.0)));
    if (v <= 0) return 0;
    const double position = std::log(v / low) / std::log(high / low);
    return static_cast<std::uint8_t>(1 + std::lround(253 * std::clamp(position, 0.0, 1.0)));
  }

  [[nodiscard]] nlohmann::json json() const {
    std::vector<std::uint8_t> codes;
    codes.reserve(values.size());
    for (const double v : values) codes.push_back(code(v));
    return {{"name", name}, {"note", note}, {"logarithmic", logarithmic},
            {"low", low},   {"high", high}, {"codes", base64(codes)}};
  }
};

/// R, G and B of each pixel as 16-bit floats, little-endian, divided by a scale.
std::string packed_halves(const Image& image, float scale) {
  const auto planes = rgb_planes(image);
  const auto pixels =
      static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  std::vector<std::uint8_t> bytes;
  bytes.reserve(6 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (const float* plane : planes) {
      const float v = plane[i] / scale;
      // The largest half stands for what exceeds it; infinity stays.
      const std::uint16_t half =
          glm::packHalf1x16(std::isfinite(v) ? std::clamp(v, -65504.F, 65504.F) : v);
      bytes.push_back(static_cast<std::uint8_t>(half & 0xFFU));
      bytes.push_back(static_cast<std::uint8_t>(half >> 8U));
    }
  }
  return base64(bytes);
}

/// The power of two that brings the images into the range of 16-bit floats, best at 1 unless they
/// need another.
float half_scale(const Image& a, const Image& b) {
  float largest = 0;
  for (const Image* image : {&a, &b}) {
    const auto pixels =
        static_cast<std::size_t>(image->width()) * static_cast<std::size_t>(image->height());
    for (const float* plane : rgb_planes(*image)) {
      for (std::size_t i = 0; i < pixels; ++i) {
        if (std::isfinite(plane[i])) largest = std::max(largest, std::abs(plane[i]));
      }
    }
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  // Halves keep all their digits from 2^-14 to 2^15.
  return exponent > 15 || (largest > 0 && exponent < 0)
             ? std::ldexp(1.F, std::clamp(exponent - 15, -126, 127))
             : 1.F;
}

class ComparePage {
 public:
  ComparePage(const CompareOptions& options, const Comparison& comparison)
      : o_(options), c_(comparison) {
    relative_.reserve(c_.errors.terms.size());
    for (const double term : c_.errors.terms) relative_.push_back(std::sqrt(term));
  }

  [[nodiscard]] std::string html() const {
    return fill_template(
        page_text::compare_html,
        {{"style", std::string(page_text::page_css) + std::string(page_text::compare_css)},
         {"script", std::string(page_text::compare_js)},
         {"image", escape_html(o_.image)},
         {"reference", escape_html(o_.reference)},
         {"size", fmt::format("{} × {}", c_.image.width(), c_.image.height())},
         {"width", fmt::format("{}", c_.image.width())},
         {"height", fmt::format("{}", c_.image.height())},
         {"verdict", verdict()},
         {"metrics", metrics()},
         {"histograms", histograms()},
         {"worst", worst()},
         {"origins", origins()},
         {"version", FACET_VERSION},
         {"data", data().dump()}});
  }

 private:
  [[nodiscard]] std::string verdict() const {
    std::string html;
    for (const std::string& warning : c_.warnings)
      html += fmt::format("<p class=\"warning\">Warning: {}.</p>\n", escape_html(warning));
    if (!o_.has_thresholds()) return html;
    if (c_.violations.empty()) return html + "<p class=\"holds\">Every threshold holds.</p>\n";
    html += "<div class=\"fails\"><p>Thresholds that do not hold:</p><ul>";
    for (const std::string& violation : c_.violations)
      html += fmt::format("<li>{}</li>", escape_html(violation));
    return html + "</ul></div>\n";
  }

  [[nodiscard]] std::string metrics() const {
    std::string html;
    for (const MetricRow& row : metric_rows(o_, c_)) {
      html +=
          fmt::format("<tr><th scope=\"row\">{}</th><td class=\"number\">{}</td><td>{}</td></tr>\n",
                      escape_html(row.name), escape_html(row.value), escape_html(row.note));
    }
    return html;
  }

  [[nodiscard]] std::string histograms() const {
    const std::vector<double> flip(c_.flip.map.begin(), c_.flip.map.end());
    return svg_histogram({"Relative error", "relative error of the pixel", true,
                          std::sqrt(c_.errors.relmse), "√relMSE"},
                         relative_) +
           svg_histogram({"FLIP", "difference seen at the pixel", false, c_.flip.mean, "mean"},
                         flip);
  }

  [[nodiscard]] static std::string triple(const Image& image, std::size_t i) {
    const auto planes = rgb_planes(image);
    return fmt::format("{:.6g} {:.6g} {:.6g}", planes[0][i], planes[1][i], planes[2][i]);
  }

  [[nodiscard]] static std::string rerun(const char* label, const Image& image,
                                         const ParsedRecord& record, int x, int y) {
    const ImageSize size{image.window.full_width, image.window.full_height};
    std::string command = escape_html(rerun_command(record, size, x, y));
    if (command.empty()) return "";
    // Lines break between options only.
    for (std::size_t i = command.find(" --"); i != std::string::npos; i = command.find(" --", i)) {
      constexpr std::string_view between = "</span> <span>";
      command.replace(i, 1, between);
      i += between.size();
    }
    return fmt::format("<div><b class=\"tag\">{}</b> <code><span>{}</span></code></div>", label,
                       command);
  }

  /// Two rows a pixel: its values, and the commands that render it again.
  [[nodiscard]] std::string worst_pixel(std::size_t i) const {
    const auto x = static_cast<int>(i % static_cast<std::size_t>(c_.image.width()));
    const auto y = static_cast<int>(i / static_cast<std::size_t>(c_.image.width()));
    const int full_x = x + c_.image.window.x;
    const int full_y = y + c_.image.window.y;
    const std::string commands = rerun("A", c_.image, c_.image_record, full_x, full_y) +
                                 rerun("B", c_.reference, c_.reference_record, full_x, full_y);
    std::string html = fmt::format(
        "<tr{}><th scope=\"row\"><button type=\"button\" class=\"goto\" data-x=\"{}\" "
        "data-y=\"{}\">{}, "
        "{}</button></th>",
        commands.empty() ? "" : " class=\"values\"", x, y, full_x, full_y);
    for (const std::string& value :
         {triple(c_.image, i), triple(c_.reference, i), fmt::format("{:.4g}", relative_[i]),
          fmt::format("{:.3f}", c_.flip.map[i])})
      html += fmt::format("<td class=\"number\">{}</td>", value);
    html += "</tr>\n";
    if (!commands.empty())
      html +=
          fmt::format("<tr class=\"commands\"><td></td><td colspan=\"4\">{}</td></tr>\n", commands);
    return html;
  }

  [[nodiscard]] std::string worst() const {
    std::string html;
    for (const std::size_t i : worst_pixels(c_.errors, 12)) html += worst_pixel(i);
    return html.empty() ? "<tr><td colspan=\"5\">No pixel differs.</td></tr>" : html;
  }

  /// The headers side by side.
  [[nodiscard]] std::string origins() const {
    std::vector<std::string> keys;
    for (const Image* image : {&c_.image, &c_.reference}) {
      for (const auto& entry : image->metadata) {
        if (std::find(keys.begin(), keys.end(), entry.first) == keys.end())
          keys.push_back(entry.first);
      }
    }
    std::string html;
    for (const std::string& key : keys) {
      const auto text = [&](const Image& image) {
        const std::string* found = find_metadata(image.metadata, key);
        return found != nullptr ? *found : "";
      };
      const std::string a = text(c_.image);
      const std::string b = text(c_.reference);
      html += fmt::format("<tr{}><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n",
                          a == b ? "" : " class=\"differs\"", escape_html(key), escape_html(a),
                          escape_html(b));
    }
    return html.empty() ? "<tr><td colspan=\"3\">The files do not say.</td></tr>" : html;
  }

  /// For the script; no text from outside, which could end its element.
  [[nodiscard]] nlohmann::json data() const {
    const float scale = half_scale(c_.image, c_.reference);
    const Decades decades = decades_of(relative_);
    const ErrorMap flip{"FLIP", "difference seen on an sRGB display at exposure 0",
                        false,  0,
                        1,      {c_.flip.map.begin(), c_.flip.map.end()}};
    const ErrorMap hdr{"HDR-FLIP", "largest difference seen at any of the exposures", false, 0,
                       1,          {c_.hdr_flip.map.begin(), c_.hdr_flip.map.end()}};
    const ErrorMap relative{"Relative error",
                            "root of the pixel's term of relMSE",
                            true,
                            std::pow(10.0, decades.first),
                            std::pow(10.0, decades.end),
                            relative_};
    return {{"width", c_.image.width()},
            {"height", c_.image.height()},
            {"x", c_.image.window.x},
            {"y", c_.image.window.y},
            {"scale", scale},
            {"a", packed_halves(c_.image, scale)},
            {"b", packed_halves(c_.reference, scale)},
            {"maps", {flip.json(), hdr.json(), relative.json()}}};
  }

  const CompareOptions& o_;
  const Comparison& c_;
  std::vector<double> relative_;
};

}  // namespace

void write_compare_page(const std::string& path, const CompareOptions& options,
                        const Comparison& comparison) {
  if (comparison.errors.pixels > most_pixels) {
    throw InputError(fmt::format("{}: a page holds at most {} pixels, not {}; render a --crop",
                                 path, most_pixels, comparison.errors.pixels));
  }
  write_text(path, ComparePage(options, comparison).html());
}

}  // namespace facet::report
