#pragma once
// A number that tells scenes apart by what they hold.
#include <cstdint>

#include "scene/scene.h"

namespace facet {

/// 64-bit hash of everything in the scene that decides about its image's expectation and how that
/// is estimated, and that no other entry of a RenderRecord tells: meshes, BSDFs, emitters,
/// textures, camera with its filter, the light of the integrator `simple`. Names and places of
/// files, the size of the image, the integrator's choices, the sampler, the number of samples and
/// the seed have no part in it.
///
/// It hashes values (bits of numbers as parsed and transformed, lengths of lists, names of types),
/// never memory: pointers, padding and byte order do not matter. Not for security: collisions can
/// be made.
[[nodiscard]] std::uint64_t fingerprint(const Scene& scene);

}  // namespace facet
