#include "scene/mesh/obj.h"

#include <tiny_obj_loader.h>

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "scene/mesh/obj_check.h"

namespace facet {

namespace {

tinyobj::ObjReader parse(const std::filesystem::path& path, const std::string& text) {
  tinyobj::ObjReaderConfig config;
  config.triangulate = true;
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  if (!reader.ParseFromString(text, "", config)) {
    std::string why = reader.Error().empty() ? "not a readable OBJ file" : reader.Error();
    while (!why.empty() && (why.back() == '\n' || why.back() == ' ')) why.pop_back();
    throw InputError(fmt::format("{}: {}", path.string(), why));
  }
  return reader;
}

std::vector<vec3> transform_points(const std::vector<tinyobj::real_t>& v, const dmat4& m,
                                   const std::filesystem::path& path) {
  std::vector<vec3> points(v.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec4 p = m * glm::dvec4(v[3 * i], v[3 * i + 1], v[3 * i + 2], 1);
    points[i] = vec3(dvec3(p) / p.w);
    if (!std::isfinite(points[i].x + points[i].y + points[i].z)) {
      throw InputError(fmt::format("{}: vertex {} is not finite in the world's space", path.string(), i + 1));
    }
  }
  return points;
}

std::vector<vec3> transform_normals(const std::vector<tinyobj::real_t>& v, const dmat4& m) {
  const glm::dmat3 cofactor = glm::transpose(glm::inverse(glm::dmat3(m)));
  std::vector<vec3> normals(v.size() / 3);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const dvec3 n = cofactor * dvec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
    const double length = glm::length(n);
    // A zero normal stays zero: shading falls back to the geometric one.
    normals[i] = length > 0 && std::isfinite(length) ? vec3(n / length) : vec3(0);
  }
  return normals;
}

/// The three indices of a kind; none in x where a corner has none. check_obj has looked at their ranges.
uvec3 triangle_indices(int a, int b, int c) {
  if (a < 0 || b < 0 || c < 0) return uvec3(none);
  return {a, b, c};
}

void append_triangles(Mesh& mesh, const tinyobj::mesh_t& shape) {
  for (std::size_t i = 0; i + 2 < shape.indices.size(); i += 3) {
    const auto& [a, b, c] = std::tie(shape.indices[i], shape.indices[i + 1], shape.indices[i + 2]);
    mesh.position_indices.push_back(triangle_indices(a.vertex_index, b.vertex_index, c.vertex_index));
    mesh.normal_indices.push_back(triangle_indices(a.normal_index, b.normal_index, c.normal_index));
    mesh.texcoord_indices.push_back(triangle_indices(a.texcoord_index, b.texcoord_index, c.texcoord_index));
  }
}

/// Drops index lists that no triangle uses.
void drop_unused(std::vector<uvec3>& indices) {
  if (std::all_of(indices.begin(), indices.end(), [](const uvec3& i) { return i.x == none; }))
    indices.clear();
}

}  // namespace

Mesh read_obj(const std::filesystem::path& path, const dmat4& to_world, const SourceLocation& where,
              Diagnostics& diagnostics) {
  std::ifstream in(path, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(path))
    throw InputError(where, fmt::format("cannot read the mesh {}", path.string()));
  std::ostringstream buffer;
  buffer << in.rdbuf();
  const std::string text = buffer.str();
  check_obj(path, text);
  const tinyobj::ObjReader reader = parse(path, text);
  const tinyobj::attrib_t& attributes = reader.GetAttrib();

  Mesh mesh;
  mesh.name = path.filename().string();
  mesh.where = where;
  mesh.positions = transform_points(attributes.vertices, to_world, path);
  mesh.normals = transform_normals(attributes.normals, to_world);
  mesh.texcoords.resize(attributes.texcoords.size() / 2);
  for (std::size_t i = 0; i < mesh.texcoords.size(); ++i) {
    mesh.texcoords[i] = vec2(attributes.texcoords[2 * i], attributes.texcoords[2 * i + 1]);
  }
  for (const tinyobj::shape_t& shape : reader.GetShapes()) append_triangles(mesh, shape.mesh);
  drop_unused(mesh.normal_indices);
  drop_unused(mesh.texcoord_indices);
  if (mesh.position_indices.empty())
    diagnostics.warn(where, fmt::format("the mesh {} has no faces", path.string()));
  return mesh;
}

}  // namespace facet
