#pragma once
// How many samples each pixel of an adaptive render gets (docs/reference/sampling.md, "Adaptive
// sampling").
#include <facet/film.h>

#include <utility>

namespace facet {

/// Samples of every pixel whose variance decides about the others, of a render of `mean` samples a
/// pixel: a power of two. They are not part of the image.
[[nodiscard]] std::uint32_t pilot_samples(std::uint32_t mean);

/// Samples that the pixels of an allocation have in common.
[[nodiscard]] std::uint32_t smallest_allocation(std::uint32_t mean);

/// What a pilot says of its pixels' needs.
class Allocation {
 public:
  /// first_half: the pilot's film after half of its samples, pilot: after all; both with squares.
  Allocation(const Film& first_half, const Film& pilot);
  /// With the wishes of another.
  explicit Allocation(std::vector<double> wishes) : wishes_(std::move(wishes)) {}

  /// Logarithms to base 2 of samples in proportion, one a pixel.
  [[nodiscard]] const std::vector<double>& wishes() const { return wishes_; }

  /// Samples of each pixel, powers of two, from the smallest that any pixel gets to 64 times the
  /// mean; together no more than `budget` for each.
  [[nodiscard]] std::vector<std::uint32_t> counts(std::uint32_t mean, std::uint32_t budget) const;

 private:
  std::vector<double> wishes_;
};

}  // namespace facet
