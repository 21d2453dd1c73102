#pragma once
// The page of facet compare --html.
#include "compare/comparison.h"

namespace facet::report {

/// Writes one HTML file that needs nothing else: both images with swipe, flip and exposure, maps
/// and histograms of the differences, the worst pixels with the commands that render them again,
/// all metrics, and how the images were made. Throws InputError where it cannot be written, or for
/// images of more than 2^23 pixels.
void write_compare_page(const std::string& path, const CompareOptions& options,
                        const Comparison& comparison);

}  // namespace facet::report
