#include "cli/comparison.h"

#include <cmath>
#include <filesystem>

#include "cli/metadata.h"
#include "core/error.h"
#include "image/files.h"

namespace facet::cli {

namespace {

constexpr std::array<const char*, 3> variance_channels{"variance.R", "variance.G", "variance.B"};

bool has_variance(const Image& image) {
  for (const char* name : {"variance.R", "variance.G", "variance.B", "samples", "samples.nonzero"}) {
    if (image.find_channel(name) < 0) return false;
  }
  return true;
}

/// Pixels whose variance overflowed: no test of them can fail.
std::size_t count_bad_variances(const Image& image) {
  std::size_t count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      bool bad = false;
      for (const char* name : variance_channels)
        bad = bad || !std::isfinite(image.at(x, y, image.find_channel(name)));
      if (bad) ++count;
    }
  }
  return count;
}

/// None but an EXR knows its place in a larger frame.
void place(const std::string& name, Image& image, const Image& other) {
  const bool fits = image.width() == other.width() && image.height() == other.height();
  if (fits && image_format(name) != ImageFormat::exr) image.window = other.window;
}

class Comparing {
 public:
  explicit Comparing(const CompareOptions& options) : o_(options) {
    c_.image = read_image(o_.image);
    c_.reference = read_image(o_.reference);
    place(o_.image, c_.image, c_.reference);
    place(o_.reference, c_.reference, c_.image);
    check_comparable(c_.image, o_.image, c_.reference, o_.reference);
    for (const auto& [image, name] :
         {std::pair(&c_.image, &o_.image), std::pair(&c_.reference, &o_.reference)}) {
      if (o_.z_test && !has_variance(*image))
        throw InputError(fmt::format("{}: --z-test needs the variance channels of --aov variance", *name));
    }
  }

  Comparison run() {
    c_.errors = measure_errors(c_.image, c_.reference, o_.tolerance);
    c_.flip = flip(c_.image, c_.reference, o_.pixels_per_degree);
    c_.hdr_flip = hdr_flip(c_.image, c_.reference, o_.pixels_per_degree);
    if (has_variance(c_.image) && has_variance(c_.reference))
      c_.z_test = facet::z_test(c_.image, c_.reference, o_.significance);
    warn();
    if (o_.has_thresholds()) test();
    return std::move(c_);
  }

 private:
  void warn() {
    const ErrorMetrics& e = c_.errors;
    if (e.nonfinite > 0) {
      c_.warnings.push_back(
          fmt::format("pixels that are not finite: {} in {}, {} in {}; errors leave them out",
                      e.nonfinite_image, o_.image, e.nonfinite_reference, o_.reference));
    }
    const auto scene = find_metadata(c_.image, "facet.scene");
    const auto reference_scene = find_metadata(c_.reference, "facet.scene");
    if (scene && reference_scene && *scene != *reference_scene) {
      c_.warnings.push_back(fmt::format("the images show different scenes: {} in {}, {} in {}", *scene,
                                        o_.image, *reference_scene, o_.reference));
    }
    if (c_.z_test && share_samples(c_.image, c_.reference))
      c_.warnings.emplace_back("the images share samples of one seed; the z-test takes them for independent");
  }

  void at_most(const char* option, const char* name, double value, const std::optional<double>& bound) {
    // NaN exceeds every bound.
    if (bound && !(value <= *bound))
      c_.violations.push_back(fmt::format("{} is {:.6g}, above {} {:g}", name, value, option, *bound));
  }

  void test() {
    const ErrorMetrics& e = c_.errors;
    if (e.nonfinite > 0) {
      c_.violations.push_back(
          fmt::format("pixels that are not finite: {}, which no threshold lets pass", e.nonfinite));
    }
    at_most("--max-abs", "max abs", e.max_abs, o_.max_abs);
    at_most("--max-rmse", "RMSE", e.rmse, o_.max_rmse);
    at_most("--max-relmse", o_.trim ? "trimmed relMSE" : "relMSE", o_.trim ? e.relmse_trimmed : e.relmse,
            o_.max_relmse);
    at_most("--max-flip", "FLIP", c_.flip.mean, o_.max_flip);
    at_most("--max-hdrflip", "HDR-FLIP", c_.hdr_flip.mean, o_.max_hdrflip);
    at_most("--max-beyond", "the share beyond the tolerance", e.share(e.beyond), o_.max_beyond);
    if (o_.min_identical && !(e.share(e.identical) >= *o_.min_identical)) {
      c_.violations.push_back(fmt::format("the bit-identical share is {:.6g}, below --min-identical {:g}",
                                          e.share(e.identical), *o_.min_identical));
    }
    if (o_.z_test) test_z();
  }

  void test_z() {
    const std::size_t bad = count_bad_variances(c_.image) + count_bad_variances(c_.reference);
    if (bad > 0)
      c_.violations.push_back(fmt::format("--z-test: pixels whose variance is not finite: {}", bad));
    if (!c_.z_test->passed()) c_.violations.push_back("--z-test: " + c_.z_test->describe());
  }

  const CompareOptions& o_;
  Comparison c_;
};

/// "12.5 % (40 of 320 pixels)"
std::string share_text(const ErrorMetrics& e, std::size_t count) {
  return fmt::format("{:.4g} % ({} of {} pixels)", 100 * e.share(count), count, e.pixels);
}

}  // namespace

Comparison compare_images(const CompareOptions& options) { return Comparing(options).run(); }

std::vector<MetricRow> metric_rows(const CompareOptions& options, const Comparison& c) {
  const ErrorMetrics& e = c.errors;
  const Image::Window& w = c.image.window;
  std::vector<MetricRow> rows{
      {"max abs", fmt::format("{:.6g}", e.max_abs),
       fmt::format("largest difference of a channel, at pixel ({}, {})", e.max_abs_x + w.x,
                   e.max_abs_y + w.y)},
      {"RMSE", fmt::format("{:.6g}", e.rmse), "root of the mean squared difference over pixels and channels"},
      {"relMSE", fmt::format("{:.6g}", e.relmse),
       fmt::format("mean of (a - r)\u00b2 / (r\u00b2 + \u03b5), \u03b5 = {:.3g}", e.epsilon())},
      {"relMSE, trimmed", fmt::format("{:.6g}", e.relmse_trimmed),
       fmt::format("without the largest pixel terms, {} of them", e.trimmed)},
      {"FLIP", fmt::format("{:.6g}", c.flip.mean),
       fmt::format("mean, largest {:.4g}; sRGB at exposure 0, {:g} pixels a degree", c.flip.largest,
                   options.pixels_per_degree)},
      {"HDR-FLIP", fmt::format("{:.6g}", c.hdr_flip.mean),
       fmt::format("mean, largest {:.4g}; {} exposures from {:.2f} to {:.2f} stops", c.hdr_flip.largest,
                   c.hdr_flip.exposures, c.hdr_flip.start_exposure, c.hdr_flip.stop_exposure)},
      {"bit-identical", share_text(e, e.identical), "R, G and B equal in all bits"},
      {"beyond tolerance", share_text(e, e.beyond),
       fmt::format("|a - r| > {:g} (|r| + {:.3g}) in a channel", options.tolerance,
                   0.01 * std::abs(e.mean_luminance))},
  };
  if (e.nonfinite > 0)
    rows.push_back({"not finite", share_text(e, e.nonfinite), "left out of all errors above"});
  if (c.z_test) {
    rows.push_back({"z-test", c.z_test->passed() ? "holds" : "does not hold",
                    fmt::format("significance {:g}: {}", options.significance, c.z_test->describe())});
  }
  return rows;
}

nlohmann::ordered_json comparison_json(const CompareOptions& options, const Comparison& c) {
  const ErrorMetrics& e = c.errors;
  const Image::Window& w = c.image.window;
  nlohmann::ordered_json json{
      {"image", options.image},
      {"reference", options.reference},
      {"width", c.image.width()},
      {"height", c.image.height()},
      {"non_finite",
       {{"image", e.nonfinite_image}, {"reference", e.nonfinite_reference}, {"either", e.nonfinite}}},
      {"mean_luminance", e.mean_luminance},
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
      {"beyond", {{"tolerance", options.tolerance}, {"pixels", e.beyond}, {"share", e.share(e.beyond)}}},
      {"z_test", nullptr},
      {"warnings", c.warnings},
      {"violations", c.violations},
  };
  if (c.z_test) {
    json["z_test"] = {{"passed", c.z_test->passed()},     {"significance", options.significance},
                      {"largest_z", c.z_test->largest_z}, {"critical_z", c.z_test->critical_z},
                      {"tests", c.z_test->cells},         {"untestable", c.z_test->untestable},
                      {"unequal", c.z_test->unequal}};
  }
  return json;
}

}  // namespace facet::cli
