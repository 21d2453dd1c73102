#include "compare/comparison.h"

#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "image/files.h"

namespace facet {

namespace {

constexpr std::array<const char*, 3> variance_channels{"variance.R", "variance.G", "variance.B"};

bool has_variance(const Image& image) {
  for (const char* name :
       {"variance.R", "variance.G", "variance.B", "samples", "samples.nonzero"}) {
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
    c_.image_record = parse_record(c_.image.metadata);
    c_.reference_record = parse_record(c_.reference.metadata);
    place(o_.image, c_.image, c_.reference);
    place(o_.reference, c_.reference, c_.image);
    check_comparable(c_.image, o_.image, c_.reference, o_.reference);
    for (const auto& [image, name] :
         {std::pair(&c_.image, &o_.image), std::pair(&c_.reference, &o_.reference)}) {
      if (o_.z_test && !has_variance(*image))
        throw InputError(
            fmt::format("{}: --z-test needs the variance channels of --aov variance", *name));
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
    const RenderRecord& a = c_.image_record.record;
    const RenderRecord& b = c_.reference_record.record;
    if (!a.scene.empty() && !b.scene.empty() && a.scene != b.scene) {
      c_.warnings.push_back(fmt::format("the images show different scenes: {} in {}, {} in {}",
                                        a.scene, o_.image, b.scene, o_.reference));
    }
    if (c_.z_test && !a.scene.empty() && share_samples(a, b))
      c_.warnings.emplace_back(
          "the images share samples of one seed; the z-test takes them for independent");
  }

  void at_most(const char* option, const char* name, double value,
               const std::optional<double>& bound) {
    // NaN exceeds every bound.
    if (bound)
      add(fmt::format("{} {:g}", option, *bound), value <= *bound,
          fmt::format("{} is {:.6g}, above {} {:g}", name, value, option, *bound));
  }

  void add(const std::string& name, bool holds, const std::string& violation) {
    c_.thresholds.push_back({name, holds ? "" : violation});
  }

  void test() {
    const ErrorMetrics& e = c_.errors;
    add("all pixels are finite", e.nonfinite == 0,
        fmt::format("pixels that are not finite: {}, which no threshold lets pass", e.nonfinite));
    at_most("--max-mean", "the distance of a channel's mean ratio from 1", e.mean_change(),
            o_.max_mean);
    at_most("--max-abs", "max abs", e.max_abs, o_.max_abs);
    at_most("--max-rmse", "RMSE", e.rmse, o_.max_rmse);
    at_most("--max-relmse", o_.trim ? "trimmed relMSE" : "relMSE",
            o_.trim ? e.relmse_trimmed : e.relmse, o_.max_relmse);
    at_most("--max-flip", "FLIP", c_.flip.mean, o_.max_flip);
    at_most("--max-hdrflip", "HDR-FLIP", c_.hdr_flip.mean, o_.max_hdrflip);
    at_most("--max-beyond", "the share beyond the tolerance", e.share(e.beyond), o_.max_beyond);
    if (o_.min_identical)
      add(fmt::format("--min-identical {:g}", *o_.min_identical),
          e.share(e.identical) >= *o_.min_identical,
          fmt::format("the bit-identical share is {:.6g}, below --min-identical {:g}",
                      e.share(e.identical), *o_.min_identical));
    if (o_.z_test) test_z();
  }

  void test_z() {
    const std::size_t bad = count_bad_variances(c_.image) + count_bad_variances(c_.reference);
    add("variances are finite", bad == 0,
        fmt::format("--z-test: pixels whose variance is not finite: {}", bad));
    add("--z-test", c_.z_test->passed(), "--z-test: " + c_.z_test->describe());
  }

  const CompareOptions& o_;
  Comparison c_;
};

}  // namespace

std::vector<std::string> Comparison::violations() const {
  std::vector<std::string> lines;
  for (const Threshold& threshold : thresholds) {
    if (!threshold.violation.empty()) lines.push_back(threshold.violation);
  }
  return lines;
}

Comparison compare_images(const CompareOptions& options) { return Comparing(options).run(); }

}  // namespace facet
