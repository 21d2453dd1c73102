#pragma once
// From a scene file to a Scene.
#include <filesystem>

#include "core/diagnostics.h"
#include "image/files.h"
#include "scene/scene.h"

namespace facet {

/// What a caller replaces, so that a scene whose own is unknown can be read all the same, with a
/// warning.
struct Overridden {
  bool integrator = false;
  bool sampler = false;
};

/// Reads a scene in Nori's language. Throws InputError with file and line for whatever is wrong. A
/// scene without an integrator is left with an integrator of empty name, for the command line to
/// fill in.
[[nodiscard]] Scene read_scene(const std::filesystem::path& path, Diagnostics& diagnostics,
                               const Overridden& overridden = {});

/// Throws InputError unless width x height lies within the limits above.
void check_image_size(long long width, long long height);

}  // namespace facet
