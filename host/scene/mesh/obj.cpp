#include "scene/mesh/obj.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/mesh/obj_file.h"
#include "scene/mesh/triangulate.h"

namespace facet {

namespace {

void transform_points(std::vector<vec3>& points, const dmat4& m,
                      const std::filesystem::path& path) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec4 p = m * glm::dvec4(points[i], 1);
    points[i] = vec3(dvec3(p) / p.w);
    if (!std::isfinite(points[i].x + points[i].y + points[i].z)) {
      throw InputError(
          fmt::format("{}: vertex {} is not finite in the world's space", path.string(), i + 1));
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

/// Triangles of faces, with the material of each.
class TriangleWriter {
 public:
  explicit TriangleWriter(const ObjFile& file) : file_(file) {
    const std::size_t count = file.corners.size() - 2 * file.faces.size();
    for (std::vector<uvec3>* list :
         {&mesh.position_indices, &mesh.normal_indices, &mesh.texcoord_indices})
      list->reserve(count);
    materials.reserve(count);
  }

  void write_all() {
    std::span<const ObjCorner> rest(file_.corners);
    for (const ObjFace& face : file_.faces) {
      write_face(rest.first(face.size));
      materials.resize(mesh.position_indices.size(), face.material);
      rest = rest.subspan(face.size);
    }
    drop_unused(mesh.normal_indices);
    drop_unused(mesh.texcoord_indices);
  }

  Mesh mesh;                             ///< its indices
  std::vector<std::uint32_t> materials;  ///< of the triangles

 private:
  void write_face(std::span<const ObjCorner> face) {
    if (face.size() == 3) return write_triangle(face[0], face[1], face[2]);
    polygon_.clear();
    for (const ObjCorner& corner : face) polygon_.push_back(file_.positions[corner.position]);
    for (const auto& [a, b, c] : triangulate(polygon_)) write_triangle(face[a], face[b], face[c]);
  }

  void write_triangle(const ObjCorner& a, const ObjCorner& b, const ObjCorner& c) {
    mesh.position_indices.emplace_back(a.position, b.position, c.position);
    mesh.normal_indices.push_back(all_or_none(a.normal, b.normal, c.normal));
    mesh.texcoord_indices.push_back(all_or_none(a.texcoord, b.texcoord, c.texcoord));
  }

  /// none in x where a corner has none.
  static uvec3 all_or_none(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return a == none || b == none || c == none ? uvec3(none) : uvec3(a, b, c);
  }

  /// Drops index lists that no triangle uses.
  static void drop_unused(std::vector<uvec3>& indices) {
    if (std::all_of(indices.begin(), indices.end(), [](const uvec3& i) { return i.x == none; }))
      indices.clear();
  }

  const ObjFile& file_;
  std::vector<vec3> polygon_;
};

/// A file in the world.
struct PlacedFile {
  Mesh mesh;
  std::vector<std::uint32_t> materials;  ///< of its triangles, indices into `names`; or none
  std::vector<std::string> names;
  std::vector<std::string> files;
};

PlacedFile read_and_place(const std::filesystem::path& path, const dmat4& to_world,
                          const SourceLocation& where, Diagnostics& diagnostics) {
  ObjFile file = read_obj_file(path, where, diagnostics);
  TriangleWriter writer(file);
  writer.write_all();
  transform_points(file.positions, to_world, path);
  transform_normals(file.normals, to_world);
  Mesh& mesh = writer.mesh;
  mesh.name = path.filename().string();
  mesh.where = where;
  mesh.positions = std::move(file.positions);
  mesh.normals = std::move(file.normals);
  mesh.texcoords = std::move(file.texcoords);
  if (mesh.position_indices.empty())
    diagnostics.warn(where, fmt::format("the mesh {} has no faces", path.string()));
  return {std::move(mesh), std::move(writer.materials), std::move(file.materials),
          std::move(file.material_files)};
}

/// The vertex data that some of a mesh's triangles use, without the rest of it.
class Gatherer {
 public:
  explicit Gatherer(std::size_t count) : places_(count, none) {}

  /// The triangles' corners as they come, with the values that these refer to.
  template <typename Value>
  void gather(const std::vector<uvec3>& indices, const std::vector<Value>& values,
              const std::vector<std::uint32_t>& triangles, std::vector<uvec3>& gathered_indices,
              std::vector<Value>& gathered_values) {
    if (indices.empty()) return;
    for (const std::uint32_t t : triangles) {
      uvec3 moved = indices[t];
      for (int i = 0; i < 3 && moved.x != none; ++i) {
        std::uint32_t& place = places_[moved[i]];
        if (place == none) {
          place = static_cast<std::uint32_t>(gathered_values.size());
          gathered_values.push_back(values[moved[i]]);
        }
        moved[i] = place;
      }
      gathered_indices.push_back(moved);
    }
  }

 private:
  std::vector<std::uint32_t> places_;
};

Mesh part_of(const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
  Mesh part;
  part.name = mesh.name;
  part.where = mesh.where;
  Gatherer(mesh.positions.size())
      .gather(mesh.position_indices, mesh.positions, triangles, part.position_indices,
              part.positions);
  Gatherer(mesh.normals.size())
      .gather(mesh.normal_indices, mesh.normals, triangles, part.normal_indices, part.normals);
  Gatherer(mesh.texcoords.size())
      .gather(mesh.texcoord_indices, mesh.texcoords, triangles, part.texcoord_indices,
              part.texcoords);
  return part;
}

}  // namespace

Mesh read_obj(const std::filesystem::path& path, const dmat4& to_world, const SourceLocation& where,
              Diagnostics& diagnostics) {
  return read_and_place(path, to_world, where, diagnostics).mesh;
}

ObjParts read_obj_by_material(const std::filesystem::path& path, const dmat4& to_world,
                              const SourceLocation& where, Diagnostics& diagnostics) {
  PlacedFile file = read_and_place(path, to_world, where, diagnostics);
  std::vector<std::uint32_t> order;
  std::map<std::uint32_t, std::vector<std::uint32_t>> triangles;
  for (std::size_t t = 0; t < file.materials.size(); ++t) {
    std::vector<std::uint32_t>& same = triangles[file.materials[t]];
    if (same.empty()) order.push_back(file.materials[t]);
    same.push_back(static_cast<std::uint32_t>(t));
  }
  ObjParts parts;
  parts.material_files = std::move(file.files);
  for (const std::uint32_t material : order)
    parts.materials.push_back(material == none ? "" : file.names[material]);
  if (order.size() < 2) {
    parts.materials.resize(1);
    parts.meshes.push_back(std::move(file.mesh));
    return parts;
  }
  for (const std::uint32_t material : order)
    parts.meshes.push_back(part_of(file.mesh, triangles[material]));
  return parts;
}

}  // namespace facet
