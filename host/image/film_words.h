#pragma once
// The sums of films as words, with every bit of them.
#include <facet/film.h>

#include "image/render_state.h"

namespace facet {

/// Planes that sums take: three values and three squares in double, and two counts.
inline constexpr std::size_t planes_of_sums = 14;

/// The words of some pixels' sums.
[[nodiscard]] std::vector<WordPlane> words_of(const std::vector<PixelSums>& pixels);

/// The reverse. Throws std::invalid_argument unless there are planes_of_sums planes of one size.
[[nodiscard]] std::vector<PixelSums> sums_of(const std::vector<WordPlane>& planes);

/// Halves of numbers in double.
[[nodiscard]] std::vector<WordPlane> words_of(const std::vector<double>& values);

/// The reverse. Throws std::invalid_argument unless there are two planes of one size.
[[nodiscard]] std::vector<double> doubles_of(const std::vector<WordPlane>& planes);

}  // namespace facet
