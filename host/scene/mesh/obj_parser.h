#pragma once
// The text of a Wavefront OBJ file, parsed on all cores.
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/maths.h"

namespace facet {

/// Indices from 0; none where a corner has no texture coordinates or no normal.
struct ObjCorner {
  std::uint32_t position = none;
  std::uint32_t texcoord = none;
  std::uint32_t normal = none;
};

/// Faces of at least three corners.
struct ObjFaces {
  std::vector<ObjCorner> corners;    ///< of one face after another
  std::vector<std::uint32_t> sizes;  ///< how many corners each has
};

struct ObjText {
  std::vector<vec3> positions;
  std::vector<vec2> texcoords;
  std::vector<vec3> normals;
  std::vector<ObjFaces> faces;  ///< in the file's order, in several portions
};

/// Throws InputError with the line for what is no OBJ file: the first such line, whatever the number of
/// threads. All coordinates are finite, all indices in range. Keywords other than v, vt, vn and f do not
/// matter.
[[nodiscard]] ObjText parse_obj(const std::filesystem::path& path, std::string_view text);

}  // namespace facet
