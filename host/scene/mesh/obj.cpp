#include "scene/mesh/obj.h"

#include <tiny_obj_loader.h>

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/text.h"

namespace facet {

namespace {

/// Calls body(line number, line) for every line.
template <typename Body>
void for_each_line(std::string_view text, const Body& body) {
  int number = 1;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    body(number++, text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

/// tinyobjloader reads what is no number as 0, so coordinates are looked at first: a quick pass over the
/// characters finds the suspicious lines, and only those are parsed.
void check_coordinates(const std::filesystem::path& path, std::string_view text) {
  constexpr std::string_view numeric = "0123456789+-.eE \t\r";
  std::array<bool, 256> is_numeric{};
  for (const char c : numeric) is_numeric[static_cast<unsigned char>(c)] = true;
  for_each_line(text, [&](int number, std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.size() < 2 || line[0] != 'v' ||
        (line[1] != ' ' && line[1] != '\t' && line[1] != 'n' && line[1] != 't'))
      return;
    const std::string_view rest = line.substr(2);
    if (std::all_of(rest.begin(), rest.end(),
                    [&](char c) { return is_numeric[static_cast<unsigned char>(c)]; }))
      return;
    const std::string_view without_comment = rest.substr(0, rest.find('#'));
    for (const std::string_view part : split_list(without_comment)) {
      if (!parse_real(part))
        throw InputError({path.string(), number}, fmt::format("\"{}\" is not a finite number", part));
    }
  });
}

/// The first line that names a vertex which does not exist; for the message only.
int find_bad_index(std::string_view text) {
  std::array<long long, 3> counts{};
  int bad = 0;
  for_each_line(text, [&](int number, std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.starts_with("v ")) ++counts[0];
    if (line.starts_with("vt")) ++counts[1];
    if (line.starts_with("vn")) ++counts[2];
    if (!line.starts_with("f ") || bad != 0) return;
    for (std::string_view corner : split_list(line.substr(2))) {
      for (std::size_t k = 0; k < 3 && !corner.empty(); ++k) {
        const std::size_t end = std::min(corner.find('/'), corner.size());
        const auto index = parse_integer(corner.substr(0, end));
        if (index && (*index == 0 || std::abs(*index) > counts[k])) bad = number;
        corner.remove_prefix(std::min(end + 1, corner.size()));
      }
    }
  });
  return bad;
}

tinyobj::ObjReader parse(const std::filesystem::path& path, const std::string& text) {
  tinyobj::ObjReaderConfig config;
  config.triangulate = true;
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  if (!reader.ParseFromString(text, "", config)) {
    std::string why = reader.Error().empty() ? "not a readable OBJ file" : reader.Error();
    while (!why.empty() && (why.back() == '\n' || why.back() == ' ')) why.pop_back();
    throw InputError({path.string(), find_bad_index(text)}, why);
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

/// The three indices of a kind, checked; none in x where a corner has none.
uvec3 triangle_indices(const std::array<int, 3>& corners, std::size_t count,
                       const std::filesystem::path& path, const std::string& text) {
  if (corners[0] < 0 || corners[1] < 0 || corners[2] < 0) return uvec3(none);
  for (const int c : corners) {
    if (static_cast<std::size_t>(c) < count) continue;
    throw InputError({path.string(), find_bad_index(text)},
                     fmt::format("index {} is out of range: there are {}", c + 1, count));
  }
  return {corners[0], corners[1], corners[2]};
}

void append_triangles(Mesh& mesh, const tinyobj::mesh_t& shape, const std::filesystem::path& path,
                      const std::string& text) {
  for (std::size_t i = 0; i + 2 < shape.indices.size(); i += 3) {
    const auto& [a, b, c] = std::tie(shape.indices[i], shape.indices[i + 1], shape.indices[i + 2]);
    const uvec3 p =
        triangle_indices({a.vertex_index, b.vertex_index, c.vertex_index}, mesh.positions.size(), path, text);
    if (p.x == none) {
      throw InputError({path.string(), find_bad_index(text)}, "a face names a vertex that does not exist");
    }
    mesh.position_indices.push_back(p);
    mesh.normal_indices.push_back(
        triangle_indices({a.normal_index, b.normal_index, c.normal_index}, mesh.normals.size(), path, text));
    mesh.texcoord_indices.push_back(triangle_indices({a.texcoord_index, b.texcoord_index, c.texcoord_index},
                                                     mesh.texcoords.size(), path, text));
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
  if (!in || std::filesystem::is_directory(path))
    throw InputError(where, fmt::format("cannot read the mesh {}", path.string()));
  std::ostringstream buffer;
  buffer << in.rdbuf();
  const std::string text = buffer.str();
  check_coordinates(path, text);
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
  for (const tinyobj::shape_t& shape : reader.GetShapes()) append_triangles(mesh, shape.mesh, path, text);
  drop_unused(mesh.normal_indices);
  drop_unused(mesh.texcoord_indices);
  if (mesh.position_indices.empty())
    diagnostics.warn(where, fmt::format("the mesh {} has no faces", path.string()));
  return mesh;
}

}  // namespace facet
