#pragma once
// Errors of one image against another.
#include <facet/film.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/maths.h"

namespace facet {

/// The planes R, G and B of an image. Throws InputError where one is missing.
[[nodiscard]] std::array<const float*, 3> rgb_planes(const Image& image);

/// Throws InputError, with both names and sizes, unless the images have R, G and B, the same size
/// and the same place in their frame.
void check_comparable(const Image& a, const std::string& name_a, const Image& b,
                      const std::string& name_b);

/// Errors of an image a against a reference r, over the pixels that are finite in both. Sums are in
/// double.
struct ErrorMetrics {
  std::size_t pixels = 0;           ///< all of them
  std::size_t nonfinite_image = 0;  ///< pixels with a NaN or infinite channel
  std::size_t nonfinite_reference = 0;
  std::size_t nonfinite = 0;  ///< in either
  double mean_luminance = 0;  ///< of r's finite pixels
  glm::dvec3 mean_image{0};   ///< of R, G and B over the pixels finite in both
  glm::dvec3 mean_reference{0};
  double max_abs = 0;  ///< largest |a - r| of a channel
  int max_abs_x = 0;   ///< its pixel, from the image's corner
  int max_abs_y = 0;
  double rmse = 0;            ///< sqrt of the mean over pixels and channels of (a - r)^2
  double relmse = 0;          ///< mean over pixels and channels of (a - r)^2 / (r^2 + epsilon)
  double relmse_trimmed = 0;  ///< the same without the `trimmed` pixels whose terms are largest
  std::size_t trimmed =
      0;  ///< a thousandth of the finite pixels, rounded up, but never all of them
  std::size_t identical =
      0;  ///< pixels whose R, G and B are equal in all bits: NaN equals itself, -0 is not 0
  std::size_t beyond = 0;  ///< pixels beyond the tolerance; those that are not finite are
  std::vector<double>
      terms;  ///< each pixel's term of relMSE, rows from the top; NaN where not finite

  /// (0.01 * mean luminance of r)^2. In a black reference it is 0: an equal pixel's term is 0 then,
  /// another's infinite.
  [[nodiscard]] double epsilon() const { return 1e-4 * mean_luminance * mean_luminance; }
  /// Mean luminance of a over that of r, of the pixels finite in both.
  [[nodiscard]] double mean_ratio() const {
    return ratio(luminance(mean_image), luminance(mean_reference));
  }
  /// The same of R, G and B.
  [[nodiscard]] glm::dvec3 mean_ratios() const {
    return {ratio(mean_image.r, mean_reference.r), ratio(mean_image.g, mean_reference.g),
            ratio(mean_image.b, mean_reference.b)};
  }
  /// The farthest that one of mean_ratios() is from 1.
  [[nodiscard]] double mean_change() const;
  [[nodiscard]] double share(std::size_t count) const {
    return static_cast<double>(count) / static_cast<double>(pixels);
  }

 private:
  /// 1 where both are equal, black too; infinite where only r is 0, NaN where there are no pixels.
  [[nodiscard]] static double ratio(double a, double r) { return a == r ? 1 : a / r; }
};

/// A pixel is beyond the tolerance t if |a - r| > t * (|r| + 0.01 * mean luminance of r) in a
/// channel: relative, with a floor for dark pixels that follows the reference's scale. With no
/// finite pixel, errors are NaN.
[[nodiscard]] ErrorMetrics measure_errors(const Image& image, const Image& reference,
                                          double tolerance);

/// Indices (y * width + x) of the pixels with the largest terms, largest first, those that are not
/// finite before all; none whose term is 0.
[[nodiscard]] std::vector<std::size_t> worst_pixels(const ErrorMetrics& metrics, std::size_t count);

}  // namespace facet
