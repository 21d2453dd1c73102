#pragma once
// What a failed chi^2 test saw, as a picture.
#include <filesystem>

#include "statistics/sphere_histogram.h"

namespace facet::report {

/// Writes a PNG of three panels, one above the other: observed, expected (both brighter for more
/// samples, on the same scale), and their difference in standard deviations (red: too many, blue:
/// too few; full colour at 5 or more). Along x runs phi from 0 to 360 degrees; the top is cos theta
/// = 1.
void write_histogram_picture(const std::filesystem::path& path,
                             const statistics::SphereHistogram& histogram);

}  // namespace facet::report
