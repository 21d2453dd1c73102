#pragma once
// The scene that `facet bench` generates, alike on every machine.
#include "scene/scene.h"

namespace facet::bench {

/// A ball with folds of all sizes on an uneven floor under a square light, of about so many triangles (each
/// of the square patches is cut evenly), without vertex normals.
[[nodiscard]] Scene generate_scene(std::size_t triangles);

/// "generated-70k"
[[nodiscard]] std::string generated_name(std::size_t triangles);

}  // namespace facet::bench
