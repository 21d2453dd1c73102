#include "report/compare_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "image/rerun.h"

namespace facet::report {

namespace {

/// "12.5 % (40 of 320 pixels)"
std::string share_text(const ErrorMetrics& e, std::size_t count) {
  return fmt::format("{:.4g} % ({} of {} pixels)", 100 * e.share(count), count, e.pixels);
}

std::string means_text(const ErrorMetrics& e) {
  const glm::dvec3 ratios = e.mean_ratios();
  return fmt::format("mean luminance {:.4g} of {:.4g}; ratios of R, G, B: {:.4g}, {:.4g}, {:.4g}",
                     luminance(e.mean_image), luminance(e.mean_reference), ratios.r, ratios.g,
                     ratios.b);
}

constexpr std::size_t worst_count = 12;

nlohmann::json rgb_json(const glm::dvec3& color) { return {color.r, color.g, color.b}; }

nlohmann::json color_json(const Image& image, std::size_t pixel) {
  const auto planes = rgb_planes(image);
  return rgb_json({planes[0][pixel], planes[1][pixel], planes[2][pixel]});
}

/// The command that renders a pixel of an image again, place i of it; empty where there is none. Of
/// an adaptive image, the pixel's own number of samples is needed.
std::string pixel_command(ParsedRecord parsed, const Image& image, std::size_t i, int x, int y) {
  if (parsed.record.adaptive) {
    const int channel = image.find_channel("samples");
    const float samples = channel < 0 ? 0 : image.plane(channel)[i];
    if (!(samples >= 1 && samples <= 1U << 30U)) return "";
    parsed.record.adaptive = false;
    parsed.record.samples = SampleRanges({0, static_cast<std::uint32_t>(samples)});
  }
  return rerun_command(parsed, {image.window.full_width, image.window.full_height}, x, y);
}

/// The pixels of the largest errors, with the commands that render them again where there are such.
nlohmann::ordered_json worst_json(const Comparison& c) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  const ImageWindow& w = c.image.window;
  for (const std::size_t i : worst_pixels(c.errors, worst_count)) {
    const auto width = static_cast<std::size_t>(c.image.width());
    const int x = static_cast<int>(i % width) + w.x;
    const int y = static_cast<int>(i / width) + w.y;
    list.push_back(
        {{"pixel", {x, y}},
         {"image", color_json(c.image, i)},
         {"reference", color_json(c.reference, i)},
         {"relative_error", std::sqrt(c.errors.terms[i])},
         {"flip", c.flip.map[i]},
         {"image_command", pixel_command(c.image_record, c.image, i, x, y)},
         {"reference_command", pixel_command(c.reference_record, c.reference, i, x, y)}});
  }
  return list;
}

}  // namespace

std::vector<MetricRow> metric_rows(const CompareOptions& options, const Comparison& c) {
  const ErrorMetrics& e = c.errors;
  const ImageWindow& w = c.image.window;
  std::vector<MetricRow> rows{
      {"mean ratio", fmt::format("{:.6g}", e.mean_ratio()), means_text(e)},
      {"max abs", fmt::format("{:.6g}", e.max_abs),
       fmt::format("largest difference of a channel, at pixel ({}, {})", e.max_abs_x + w.x,
                   e.max_abs_y + w.y)},
      {"RMSE", fmt::format("{:.6g}", e.rmse),
       "root of the mean squared difference over pixels and channels"},
      {"relMSE", fmt::format("{:.6g}", e.relmse),
       fmt::format("mean of (a - r)\u00b2 / (r\u00b2 + \u03b5), \u03b5 = {:.3g}", e.epsilon())},
      {"relMSE, trimmed", fmt::format("{:.6g}", e.relmse_trimmed),
       fmt::format("without the largest pixel terms, {} of them", e.trimmed)},
      {"FLIP", fmt::format("{:.6g}", c.flip.mean),
       fmt::format("mean, largest {:.4g}; sRGB at exposure 0, {:g} pixels a degree", c.flip.largest,
                   options.pixels_per_degree)},
      {"HDR-FLIP", fmt::format("{:.6g}", c.hdr_flip.mean),
       fmt::format("mean, largest {:.4g}; {} exposures from {:.2f} to {:.2f} stops",
                   c.hdr_flip.largest, c.hdr_flip.exposures, c.hdr_flip.start_exposure,
                   c.hdr_flip.stop_exposure)},
      {"bit-identical", share_text(e, e.identical), "R, G and B equal in all bits"},
      {"beyond tolerance", share_text(e, e.beyond),
       fmt::format("|a - r| > {:g} (|r| + {:.3g}) in a channel", options.tolerance,
                   0.01 * std::abs(e.mean_luminance))},
  };
  if (e.nonfinite > 0)
    rows.push_back({"not finite", share_text(e, e.nonfinite), "left out of all errors above"});
  if (c.z_test) {
    rows.push_back(
        {"z-test", c.z_test->passed() ? "holds" : "does not hold",
         fmt::format("significance {:g}: {}", options.significance, c.z_test->describe())});
  }
  return rows;
}

nlohmann::ordered_json comparison_json(const CompareOptions& options, const Comparison& c) {
  const ErrorMetrics& e = c.errors;
  const ImageWindow& w = c.image.window;
  nlohmann::ordered_json json{
      {"image", options.image},
      {"reference", options.reference},
      {"width", c.image.width()},
      {"height", c.image.height()},
      {"non_finite",
       {{"image", e.nonfinite_image},
        {"reference", e.nonfinite_reference},
        {"either", e.nonfinite}}},
      {"mean_luminance", e.mean_luminance},
      {"mean", {{"image", rgb_json(e.mean_image)}, {"reference", rgb_json(e.mean_reference)}}},
      {"mean_ratio", e.mean_ratio()},
      {"max_abs", e.max_abs},
      {"max_abs_pixel", {e.max_abs_x + w.x, e.max_abs_y + w.y}},
      {"rmse", e.rmse},
      {"relmse", e.relmse},
      {"relmse_trimmed", e.relmse_trimmed},
      {"trimmed_pixels", e.trimmed},
      {"flip", {{"mean", c.flip.mean}, {"largest", c.flip.largest}}},
      {"hdr_flip",
       {{"mean", c.hdr_flip.mean},
        {"largest", c.hdr_flip.largest},
        {"start_exposure", c.hdr_flip.start_exposure},
        {"stop_exposure", c.hdr_flip.stop_exposure},
        {"exposures", c.hdr_flip.exposures}}},
      {"pixels_per_degree", options.pixels_per_degree},
      {"identical", {{"pixels", e.identical}, {"share", e.share(e.identical)}}},
      {"beyond",
       {{"tolerance", options.tolerance}, {"pixels", e.beyond}, {"share", e.share(e.beyond)}}},
      {"worst", worst_json(c)},
      {"z_test", nullptr},
      {"warnings", c.warnings},
      {"violations", c.violations()},
  };
  if (c.z_test) {
    json["z_test"] = {{"passed", c.z_test->passed()},     {"significance", options.significance},
                      {"largest_z", c.z_test->largest_z}, {"critical_z", c.z_test->critical_z},
                      {"tests", c.z_test->cells},         {"untestable", c.z_test->untestable},
                      {"unequal", c.z_test->unequal}};
  }
  return json;
}

}  // namespace facet::report
