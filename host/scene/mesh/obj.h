#pragma once
// Wavefront OBJ meshes.
#include <filesystem>

#include "core/diagnostics.h"
#include "scene/scene.h"

namespace facet {

/* obj: triangles and polygons of a Wavefront OBJ file.

   | parameter | default  | meaning                        |
   |-----------|----------|--------------------------------|
   | filename  |          | relative to the scene file     |
   | toWorld   | identity | from the file's space to the scene's |

   Holds a bsdf (by default `diffuse`), and an `area` emitter where it shines. Vertex normals and texture
   coordinates are used where a triangle has them. */

/// Reads the triangles and polygons of a file (polygons are triangulated; negative indices, and vertices
/// without normals or texture coordinates, are fine), places them in the world by to_world, and leaves bsdf
/// and emitter at their defaults. Throws InputError, with the line where one is to blame, for a missing file,
/// a coordinate that is no finite number, or an index out of range.
[[nodiscard]] Mesh read_obj(const std::filesystem::path& path, const dmat4& to_world,
                            const SourceLocation& where, Diagnostics& diagnostics);

}  // namespace facet
