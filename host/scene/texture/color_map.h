#pragma once
// Images that hold values, as scenes use them.
#include "core/diagnostics.h"
#include "image/color_image.h"
#include "scene/xml/property_reader.h"

namespace facet {

/// Colours times a factor, with what no light can be brought to what is nearest: NaN and negative
/// values to 0, others to at most largest_radiance; one warning at `where` counts them.
void scale_and_clamp(ColorImage& image, const Color& factor, const std::filesystem::path& path,
                     const SourceLocation& where, Diagnostics& diagnostics);

}  // namespace facet
