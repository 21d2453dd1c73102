#pragma once
// Warnings that only the whole scene and all choices about a render can draw.
#include <facet/scene.h>

#include "core/diagnostics.h"
#include "scene/settings.h"

namespace facet {

/// Adds warnings about scenes that will be black or hidden from the camera, and about emitters
/// whose light is a matter of rounding. in_double: for a render in double precision, which narrow
/// pixels do not disturb.
void warn_about_render(const Scene& scene, const RenderSettings& settings, Diagnostics& diagnostics,
                       bool in_double = false);

/// Hands the warnings of reading to the caller.
void tell_warnings(const Diagnostics& diagnostics, const LoadOptions& options);

}  // namespace facet
