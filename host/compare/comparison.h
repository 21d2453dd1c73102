#pragma once
// All that facet compare finds out about two images.
#include <facet/film.h>

#include <optional>
#include <string>
#include <vector>

#include "compare/flip.h"
#include "compare/metrics.h"
#include "compare/z_test.h"
#include "image/record.h"

namespace facet {

/// What is asked of the comparison; a bound that is not set is not tested.
struct CompareOptions {
  std::string image;
  std::string reference;
  std::optional<double> max_mean;  ///< how far a channel's mean ratio may be from 1
  std::optional<double> max_relmse;
  std::optional<double> max_rmse;
  std::optional<double> max_abs;
  std::optional<double> max_flip;
  std::optional<double> max_hdrflip;
  std::optional<double> min_identical;
  std::optional<double> max_beyond;
  double tolerance = 1e-3;
  double significance = 0.01;
  double pixels_per_degree = default_pixels_per_degree;
  bool z_test = false;
  bool trim = false;

  /// Whether anything can make the comparison fail.
  [[nodiscard]] bool has_thresholds() const {
    return max_mean || max_relmse || max_rmse || max_abs || max_flip || max_hdrflip ||
           min_identical || max_beyond || z_test;
  }
};

/// A threshold that was asked for.
struct Threshold {
  std::string name;       ///< as the option: "--max-relmse 0.01"
  std::string violation;  ///< a line; empty where it holds
};

struct Comparison {
  Image image;
  Image reference;
  ParsedRecord image_record;  ///< as far as the images' headers tell
  ParsedRecord reference_record;
  ErrorMetrics errors;
  FlipResult flip;
  HdrFlipResult hdr_flip;
  std::optional<ZTestResult> z_test;  ///< where both images have variance channels
  std::vector<std::string> warnings;  ///< what speaks against trusting the figures
  std::vector<Threshold> thresholds;  ///< and that all pixels are finite

  /// A line for each threshold that does not hold.
  [[nodiscard]] std::vector<std::string> violations() const;
};

/// Reads and measures. Throws InputError for files that cannot be read or compared, and for a
/// z-test without variance channels.
[[nodiscard]] Comparison compare_images(const CompareOptions& options);

}  // namespace facet
