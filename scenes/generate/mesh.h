#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "vec3.h"

namespace facet::generate {

/// A triangle mesh with one unit normal per position; counter-clockwise seen from outside.
/// Texture coordinates have indices of their own, because a seam needs two of them at one position.
struct Mesh {
  struct TextureCoordinate {
    double u = 0;
    double v = 0;
  };
  struct Corner {
    std::uint32_t vertex = 0;
    std::uint32_t texture = 0;
  };

  std::vector<Vec3> positions;
  std::vector<Vec3> normals;
  std::vector<TextureCoordinate> texture_coordinates;
  std::vector<std::array<Corner, 3>> triangles;
};

/// A sphere of radius 1 around the origin, poles at y = ±1, of `2 columns (rows - 1)` triangles;
/// the vertices lie on it.
Mesh make_sphere(std::uint32_t columns, std::uint32_t rows);

/// Gives every corner a cylindrical texture coordinate around the y axis: u runs once around,
/// beginning at the back (-z), v from 0 at the lowest to 1 at the highest vertex. Triangles across
/// the seam get u beyond 1, so that they interpolate.
void map_cylindrically(Mesh& mesh);

/// Writes a Wavefront OBJ whose first line is the comment `# marker`. The file appears complete or
/// not at all.
void write_obj(const Mesh& mesh, const std::filesystem::path& file, const std::string& marker);

}  // namespace facet::generate
