#pragma once
// Warnings that only the whole scene can draw.
#include "core/diagnostics.h"
#include "scene/scene.h"

namespace facet::cli {

/// Adds warnings about scenes that will be black or hidden from the camera, and about emitters whose light is
/// a matter of rounding. in_double: for a render in double precision, which narrow pixels do not disturb.
void warn_about_scene(const Scene& scene, Diagnostics& diagnostics, bool in_double = false);

/// To standard error.
void print_warnings(const Diagnostics& diagnostics);

}  // namespace facet::cli
