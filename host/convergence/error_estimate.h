#pragma once
// What a film says about the error of its image (docs/reference/sampling.md, "Estimated error");
// the estimate itself is of the library's face.
#include <vector>

#include "convergence/relative_variance.h"

namespace facet {

/// Of every pixel.
using ColorPlane = std::vector<Color3>;

/// The standard errors of the pixels' means: from the variance of their samples and, where there
/// are probes, what the order of the samples leaves of it. For a film with squares.
[[nodiscard]] ColorPlane standard_errors(const Film& film);

/// The image with them as further channels: error.R, error.G, error.B.
[[nodiscard]] Image with_errors(const Image& image, const ColorPlane& errors);

}  // namespace facet
