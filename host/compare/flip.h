#pragma once
// FLIP: the difference that is seen when two images alternate in one place.
#include <facet/film.h>

#include <vector>

namespace facet {

/// Pixels a degree of the visual angle: a 0.7 m wide display of 3840 pixels, seen from 0.7 m.
constexpr double default_pixels_per_degree = 67;

/// Differences in [0, 1]. Pixels that are not finite in either image are black in both for their
/// neighbours' sake, NaN in the map, and left out of the mean.
struct FlipResult {
  double mean = 0;         ///< NaN where no pixel is finite
  double largest = 0;      ///< NaN where no pixel is finite
  std::vector<float> map;  ///< each pixel's difference, rows from the top
};

struct HdrFlipResult : FlipResult {
  double start_exposure = 0;  ///< stops; the shortest
  double stop_exposure = 0;
  int exposures = 0;
};

/// LDR-FLIP (P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D.
/// Fairchild: FLIP: A Difference Evaluator for Alternating Images, 2020). It is meant for what a
/// display shows: linear values are clamped to [0, 1], which is their sRGB encoding at exposure 0,
/// without tone mapping. pixels_per_degree: 1 to 1000. Symmetric in its images. Throws InputError
/// as check_comparable does.
[[nodiscard]] FlipResult flip(const Image& image, const Image& reference,
                              double pixels_per_degree = default_pixels_per_degree);

/// HDR-FLIP (P. Andersson, J. Nilsson, P. Shirley, T. Akenine-Moeller: Visualizing Errors in
/// Rendered High Dynamic Range Images, 2021): each pixel's largest LDR-FLIP over exposures under K.
/// Narkowicz's fit of the ACES tone curve. Exposures run in steps of about one stop from the one
/// that maps the reference's largest luminance to 0.85 to the one that does so with its median, two
/// at least. Negative values count as 0. Where the median is 0, that of the pixels that are not
/// black replaces it; a black reference is seen at exposure 0.
[[nodiscard]] HdrFlipResult hdr_flip(const Image& image, const Image& reference,
                                     double pixels_per_degree = default_pixels_per_degree);

}  // namespace facet
