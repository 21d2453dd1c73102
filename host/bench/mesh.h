#pragma once
// The scene that `facet bench` generates, alike on every machine.
#include "scene/scene.h"

namespace facet::bench {

/// A ball with folds of all sizes on an uneven floor under a square light, of about so many
/// triangles (each of the square patches is cut evenly), without vertex normals. With 0 emitters
/// the light is two triangles; else 8192, parted into so many emitters, a power of four up to 4096.
[[nodiscard]] Scene generate_scene(std::size_t triangles, std::size_t emitters = 0);

/// "generated-70k"
[[nodiscard]] std::string generated_name(std::size_t triangles);

}  // namespace facet::bench
