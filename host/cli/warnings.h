#pragma once
// Warnings that only the whole scene can draw.
#include "core/diagnostics.h"
#include "scene/scene.h"

namespace facet::cli {

/// Adds warnings about scenes that will be black or hidden from the camera, and about emitters whose light is
/// a matter of rounding.
void warn_about_scene(const Scene& scene, Diagnostics& diagnostics);

/// To standard error.
void print_warnings(const Diagnostics& diagnostics);

}  // namespace facet::cli
