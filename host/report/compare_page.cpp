#include "report/compare_page.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/text_file.h"
#include "report/compare_report.h"
#include "report/histogram.h"
#include "report/packed_image.h"
#include "report/page.h"
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

/// The headers side by side: [{"key", "a", "b"}].
nlohmann::ordered_json origins(const Comparison& c) {
  std::vector<std::string> keys;
  for (const Image* image : {&c.image, &c.reference}) {
    for (const auto& entry : image->metadata) {
      if (std::find(keys.begin(), keys.end(), entry.first) == keys.end())
        keys.push_back(entry.first);
    }
  }
  const auto text = [](const Image& image, const std::string& key) {
    const std::string* found = find_metadata(image.metadata, key);
    return found != nullptr ? *found : "";
  };
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const std::string& key : keys)
    list.push_back({{"key", key}, {"a", text(c.image, key)}, {"b", text(c.reference, key)}});
  return list;
}

nlohmann::ordered_json metrics(const CompareOptions& options, const Comparison& c) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const MetricRow& row : metric_rows(options, c))
    list.push_back({{"name", row.name}, {"value", row.value}, {"note", row.note}});
  return list;
}

/// What the page draws, beside the report of --json.
nlohmann::ordered_json page_data(const CompareOptions& options, const Comparison& c) {
  const float scale = half_scale(std::array{&c.image, &c.reference});
  std::vector<double> relative;
  relative.reserve(c.errors.terms.size());
  for (const double term : c.errors.terms) relative.push_back(std::sqrt(term));
  const std::vector<double> flip(c.flip.map.begin(), c.flip.map.end());
  const Decades decades = decades_of(relative);
  const ErrorMap flip_map{"FLIP", "difference seen on an sRGB display at exposure 0", false, 0, 1,
                          flip};
  const ErrorMap hdr_map{"HDR-FLIP", "largest difference seen at any of the exposures", false, 0,
                         1,          {c.hdr_flip.map.begin(), c.hdr_flip.map.end()}};
  const ErrorMap relative_map{"Relative error",
                              "root of the pixel's term of relMSE",
                              true,
                              std::pow(10.0, decades.first),
                              std::pow(10.0, decades.end),
                              relative};
  const Histogram relative_histogram{"Relative error", "relative error of the pixel", true,
                                     std::sqrt(c.errors.relmse), "√relMSE"};
  const Histogram flip_histogram{"FLIP", "difference seen at the pixel", false, c.flip.mean,
                                 "mean"};
  nlohmann::ordered_json data = comparison_json(options, c);
  data["version"] = FACET_VERSION;
  data["has_thresholds"] = options.has_thresholds();
  data["x"] = c.image.window.x;
  data["y"] = c.image.window.y;
  data["scale"] = scale;
  data["a"] = packed_halves(c.image, scale);
  data["b"] = packed_halves(c.reference, scale);
  data["maps"] = {flip_map.json(), hdr_map.json(), relative_map.json()};
  data["metrics"] = metrics(options, c);
  data["histograms"] = {histogram_json(relative_histogram, relative),
                        histogram_json(flip_histogram, flip)};
  data["origins"] = origins(c);
  return data;
}

}  // namespace

void write_compare_page(const std::string& path, const CompareOptions& options,
                        const Comparison& comparison) {
  if (comparison.errors.pixels > most_pixels) {
    throw InputError(fmt::format("{}: a page holds at most {} pixels, not {}; render a --crop",
                                 path, most_pixels, comparison.errors.pixels));
  }
  write_text(path, make_page(page_text::compare_html, {page_text::page_css, page_text::compare_css},
                             {page_text::draw_js, page_text::images_js, page_text::compare_js},
                             page_data(options, comparison)));
}

}  // namespace facet::report
