#pragma once
// The film on the host: from sums over samples to an image.
#include <vector>

#include "image/image.h"
#include "render/settings.h"
#include "shared/records.h"

namespace facet {

/// Sums of a crop's pixels, row by row.
struct FilmData {
  std::vector<shared::FilmRecord> sums;
  std::vector<shared::FilmRecord> squares;  ///< of scaled values; empty unless the variance is kept
  float square_scale = 1;                   ///< what values were multiplied by before they were squared
};

/// Channels R, G, B: the mean over samples. With squares also variance.R, variance.G, variance.B (of the
/// mean), samples and samples.nonzero.
[[nodiscard]] Image develop(const FilmData& film, const Crop& crop, int full_width, int full_height,
                            bool with_variance);

/// Estimated relative mean square error of the image against its expectation, from the variance: the mean
/// over pixels and channels of variance / (mean^2 + eps), eps = (0.01 mean luminance)^2. 0 without squares.
[[nodiscard]] double estimate_relmse(const FilmData& film);

}  // namespace facet
