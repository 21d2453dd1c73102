#pragma once
// The scenes of `facet selftest`, which need no files.
#include <facet/scene.h>

namespace facet::cli {

/// A closed room whose walls all emit 1 and reflect the albedo: every point of it shows
/// 1/(1 - albedo), for whatever path tracer (the furnace).
[[nodiscard]] ScenePtr furnace_scene(double albedo);

/// Rough metals under a lamp, direct light by both samplings: emitters, visible normals, shadows.
[[nodiscard]] ScenePtr metals_scene();

/// Paths through glass and over coated and checkered surfaces, under a lamp and an environment,
/// with Sobol points.
[[nodiscard]] ScenePtr paths_scene();

}  // namespace facet::cli
