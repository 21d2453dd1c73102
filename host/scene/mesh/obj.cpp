#include "scene/mesh/obj.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/parallel.h"
#include "scene/mesh/obj_parser.h"
#include "scene/mesh/triangulate.h"

namespace facet {

namespace {

std::string read_text(const std::filesystem::path& path, const SourceLocation& where) {
  std::ifstream in(path, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(path))
    throw InputError(where, fmt::format("cannot read the mesh {}", path.string()));
  std::string text(std::filesystem::file_size(path), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (static_cast<std::size_t>(in.gcount()) != text.size())
    throw InputError(where, fmt::format("cannot read all of the mesh {}", path.string()));
  return text;
}

void transform_points(std::vector<vec3>& points, const dmat4& m, const std::filesystem::path& path) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec4 p = m * glm::dvec4(points[i], 1);
    points[i] = vec3(dvec3(p) / p.w);
    if (!std::isfinite(points[i].x + points[i].y + points[i].z)) {
      throw InputError(fmt::format("{}: vertex {} is not finite in the world's space", path.string(), i + 1));
    }
  }
}

void transform_normals(std::vector<vec3>& normals, const dmat4& m) {
  const glm::dmat3 cofactor = glm::transpose(glm::inverse(glm::dmat3(m)));
  for (vec3& normal : normals) {
    const dvec3 n = cofactor * dvec3(normal);
    const double length = glm::length(n);
    // A zero normal stays zero: shading falls back to the geometric one.
    normal = length > 0 && std::isfinite(length) ? vec3(n / length) : vec3(0);
  }
}

/// Writes the triangles of a portion's faces into the mesh, from a place on.
class FaceWriter {
 public:
  FaceWriter(Mesh& mesh, const std::vector<vec3>& positions, std::size_t first)
      : mesh_(mesh), positions_(positions), at_(first) {}

  void write(const ObjFaces& faces) {
    std::span<const ObjCorner> rest(faces.corners);
    for (const std::uint32_t size : faces.sizes) {
      write_face(rest.first(size));
      rest = rest.subspan(size);
    }
  }

 private:
  void write_face(std::span<const ObjCorner> face) {
    if (face.size() == 3) return write_triangle(face[0], face[1], face[2]);
    std::vector<vec3> polygon;
    for (const ObjCorner& corner : face) polygon.push_back(positions_[corner.position]);
    for (const auto& [a, b, c] : triangulate(polygon)) write_triangle(face[a], face[b], face[c]);
  }

  void write_triangle(const ObjCorner& a, const ObjCorner& b, const ObjCorner& c) {
    mesh_.position_indices[at_] = {a.position, b.position, c.position};
    mesh_.normal_indices[at_] = all_or_none(a.normal, b.normal, c.normal);
    mesh_.texcoord_indices[at_] = all_or_none(a.texcoord, b.texcoord, c.texcoord);
    ++at_;
  }

  /// none in x where a corner has none.
  static uvec3 all_or_none(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return a == none || b == none || c == none ? uvec3(none) : uvec3(a, b, c);
  }

  Mesh& mesh_;
  const std::vector<vec3>& positions_;
  std::size_t at_;
};

/// The file's faces as the mesh's triangles.
void write_triangles(Mesh& mesh, const ObjText& text) {
  std::vector<std::size_t> first;
  std::size_t count = 0;
  for (const ObjFaces& faces : text.faces) {
    first.push_back(count);
    count += faces.corners.size() - 2 * faces.sizes.size();
  }
  mesh.position_indices.resize(count);
  mesh.normal_indices.resize(count);
  mesh.texcoord_indices.resize(count);
  parallel_for(text.faces.size(), 1, [&](std::size_t i, std::size_t /*end*/) {
    FaceWriter(mesh, text.positions, first[i]).write(text.faces[i]);
  });
}

/// Drops index lists that no triangle uses.
void drop_unused(std::vector<uvec3>& indices) {
  if (std::all_of(indices.begin(), indices.end(), [](const uvec3& i) { return i.x == none; }))
    indices.clear();
}

}  // namespace

Mesh read_obj(const std::filesystem::path& path, const dmat4& to_world, const SourceLocation& where,
              Diagnostics& diagnostics) {
  ObjText text = parse_obj(path, read_text(path, where));
  Mesh mesh;
  mesh.name = path.filename().string();
  mesh.where = where;
  write_triangles(mesh, text);
  transform_points(text.positions, to_world, path);
  transform_normals(text.normals, to_world);
  mesh.positions = std::move(text.positions);
  mesh.normals = std::move(text.normals);
  mesh.texcoords = std::move(text.texcoords);
  drop_unused(mesh.normal_indices);
  drop_unused(mesh.texcoord_indices);
  if (mesh.position_indices.empty())
    diagnostics.warn(where, fmt::format("the mesh {} has no faces", path.string()));
  return mesh;
}

}  // namespace facet
