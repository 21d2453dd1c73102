#pragma once
// Squared errors of images relative to a reference whose own error is known, and the bias among
// them.
#include <facet/film.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace facet::tradeoff {

/// What errors are measured against.
struct Reference {
  Image image;
  std::string file;           ///< empty where it was made
  std::string how;            ///< it was made, or its header says it was
  std::uint32_t samples = 0;  ///< a pixel; 0: the file does not say
  /// Relative variance of each pixel, over (r^2 + epsilon), by its own samples; empty: unknown.
  std::vector<double> noise;

  /// relMSE of the reference itself, as far as it is known.
  [[nodiscard]] double relmse() const;
};

/// The film as a reference. Needs squares.
[[nodiscard]] Reference make_reference(const Film& film);
/// A file with R, G and B; its variance channels say how good it is. Throws InputError.
[[nodiscard]] Reference read_reference(const std::string& file);

struct RelativeError {
  double relmse = 0;
  double trimmed = 0;  ///< without the 0.1 % largest terms of pixels
};

/// relMSE against the reference, less what the reference's own noise is expected to add.
[[nodiscard]] RelativeError relative_error(const Image& image, const Reference& reference);

/// Whether the film, of independent estimates added up, estimates another image than the reference:
/// z-tests of cells of several sizes (compare/z_test.h), at this significance together. Needs
/// squares; false where the reference's error is unknown.
[[nodiscard]] bool is_biased(const Film& film, const Reference& reference, double significance);

/// Relative bias, the root of relMSE, of what the images, independent estimates of one kind,
/// estimate: of their mean against the reference, less what noise contributes on either side. 0
/// where that leaves nothing. At least two images.
[[nodiscard]] double measure_bias(std::span<const Image> images, const Reference& reference);

/// The same against estimates with the same random numbers, image by image: the noise that both
/// have in common does not hide the difference.
[[nodiscard]] double measure_bias(std::span<const Image> images, std::span<const Image> plain,
                                  const Reference& reference);

}  // namespace facet::tradeoff
