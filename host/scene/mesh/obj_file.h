#pragma once
// What a Wavefront OBJ file says, by tinyobjloader.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/maths.h"

namespace facet {

/// Indices from 0; none where a corner has no texture coordinates or no normal.
struct ObjCorner {
  std::uint32_t position = none;
  std::uint32_t texcoord = none;
  std::uint32_t normal = none;
};

/// A polygon of at least three corners.
struct ObjFace {
  std::uint32_t size = 0;         ///< corners
  std::uint32_t material = none;  ///< index into ObjFile::materials
};

struct ObjFile {
  std::vector<vec3> positions;
  std::vector<vec2> texcoords;
  std::vector<vec3> normals;
  std::vector<ObjCorner> corners;  ///< of one face after another
  std::vector<ObjFace> faces;
  std::vector<std::string> materials;       ///< their names, in the order of their first use
  std::vector<std::string> material_files;  ///< as the file names them
};

/// Reads a file. All coordinates that a face uses are finite, all indices in range. Throws
/// InputError: with the line for a statement that cannot be read, a coordinate that is no finite
/// number, or an index out of range (for one beyond the last, only when nothing else is wrong);
/// without one for a file that holds something else, saying what. Warns at `where`, once each, of
/// flaws in what no face uses.
[[nodiscard]] ObjFile read_obj_file(const std::filesystem::path& path, const SourceLocation& where,
                                    Diagnostics& diagnostics);

}  // namespace facet
