#pragma once
// Wavefront OBJ meshes.
#include <filesystem>

#include "core/diagnostics.h"
#include "scene/scene.h"

namespace facet {

/* obj: triangles and polygons of a Wavefront OBJ file.

   Holds a bsdf and, where it shines, an `area` emitter. Vertex normals and texture coordinates are
   used where a triangle has them. Without a bsdf the file's own materials (mtllib) stand in for
   one, by their diffuse colour (Kd) and texture (map_Kd, decoded from sRGB) alone; each material
   then makes a mesh. Without these the bsdf is `diffuse`. */
struct ObjParameters {
  std::string filename;
  dmat4 to_world{1};

  template <typename Self, typename Visitor>
  static void declare(Self& p, Visitor& visit) {
    visit("filename", p.filename, parameter::File{.required = true}, "relative to the scene file");
    visit("toWorld", p.to_world, parameter::Transform{}, "from the file's space to the scene's");
  }
};

/// Reads the triangles and polygons of a file (polygons are triangulated; negative indices, and
/// vertices without normals or texture coordinates, are fine), places them in the world by
/// to_world, and leaves bsdf and emitter at their defaults. Throws InputError, with the line where
/// one is to blame, for a missing file, one that holds something else, a coordinate that is no
/// finite number, or an index out of range.
[[nodiscard]] Mesh read_obj(const std::filesystem::path& path, const dmat4& to_world,
                            const SourceLocation& where, Diagnostics& diagnostics);

/// A file's triangles by their materials.
struct ObjParts {
  std::vector<Mesh> meshes;            ///< at least one
  std::vector<std::string> materials;  ///< of each mesh; empty for what has none
  std::vector<std::string> material_files;
};

/// The same, a mesh for each material, in the order of their first triangles.
[[nodiscard]] ObjParts read_obj_by_material(const std::filesystem::path& path,
                                            const dmat4& to_world, const SourceLocation& where,
                                            Diagnostics& diagnostics);

}  // namespace facet
