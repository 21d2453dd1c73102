#include "mesh.h"

#include <charconv>
#include <numbers>

#include "asset_file.h"

namespace facet::generate {
namespace {

/// Six significant digits, independent of the locale.
void append_number(std::string& text, double value) {
  char digits[32];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 6).ptr;
  text.push_back(' ');
  text.append(digits, end);
}

void append_index(std::string& text, std::uint32_t zero_based) {
  char digits[16];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, zero_based + 1).ptr);
}

void append_vectors(std::string& text, const char* keyword, const std::vector<Vec3>& vectors) {
  for (const Vec3& v : vectors) {
    text += keyword;
    append_number(text, v.x);
    append_number(text, v.y);
    append_number(text, v.z);
    text.push_back('\n');
  }
}

void append_triangle(std::string& text, const std::array<Mesh::Corner, 3>& triangle) {
  text.push_back('f');
  for (const Mesh::Corner& corner : triangle) {
    text.push_back(' ');
    append_index(text, corner.vertex);
    text.push_back('/');
    append_index(text, corner.texture);
    text.push_back('/');
    append_index(text, corner.vertex);
  }
  text.push_back('\n');
}

/// The texture coordinate of `corner` one turn further, made on first use.
std::uint32_t next_turn(Mesh& mesh, std::vector<std::uint32_t>& shifted, std::uint32_t corner) {
  if (shifted[corner] == 0) {
    shifted[corner] = static_cast<std::uint32_t>(mesh.texture_coordinates.size());
    const auto original = mesh.texture_coordinates[corner];
    mesh.texture_coordinates.push_back({original.u + 1.0, original.v});
  }
  return shifted[corner];
}

}  // namespace

Mesh make_sphere(std::uint32_t columns, std::uint32_t rows) {
  constexpr double pi = std::numbers::pi;
  Mesh mesh;
  for (std::uint32_t row = 0; row <= rows; ++row) {
    for (std::uint32_t column = 0; column <= columns; ++column) {
      const double u = static_cast<double>(column) / columns;
      const double v = static_cast<double>(row) / rows;
      // The first and the last column are the same place; computing it once keeps the sphere
      // watertight.
      const double phi = 2.0 * pi * (column == columns ? 0.0 : u);
      const double ring_radius = row == 0 || row == rows ? 0.0 : std::sin(pi * v);
      const Vec3 point{ring_radius * std::sin(phi), -std::cos(pi * v), ring_radius * std::cos(phi)};
      mesh.positions.push_back(point);
      mesh.normals.push_back(point);
      mesh.texture_coordinates.push_back({u, v});
    }
  }
  const auto corner = [columns](std::uint32_t column, std::uint32_t row) {
    const std::uint32_t index = row * (columns + 1) + column;
    return Mesh::Corner{index, index};
  };
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      if (row > 0)
        mesh.triangles.push_back({corner(i, row), corner(i + 1, row), corner(i + 1, row + 1)});
      if (row + 1 < rows)
        mesh.triangles.push_back({corner(i, row), corner(i + 1, row + 1), corner(i, row + 1)});
    }
  }
  return mesh;
}

void map_cylindrically(Mesh& mesh) {
  double low = mesh.positions.front().y;
  double high = low;
  for (const Vec3& p : mesh.positions) {
    low = std::min(low, p.y);
    high = std::max(high, p.y);
  }
  mesh.texture_coordinates.clear();
  for (const Vec3& p : mesh.positions) {
    const double turn = std::atan2(p.x, p.z) / (2.0 * std::numbers::pi) + 0.5;
    mesh.texture_coordinates.push_back({turn, (p.y - low) / (high - low)});
  }
  std::vector<std::uint32_t> shifted(mesh.positions.size(), 0);
  for (auto& triangle : mesh.triangles) {
    double largest = 0.0;
    for (Mesh::Corner& corner : triangle) {
      corner.texture = corner.vertex;
      largest = std::max(largest, mesh.texture_coordinates[corner.vertex].u);
    }
    for (Mesh::Corner& corner : triangle) {
      const bool behind_seam = mesh.texture_coordinates[corner.vertex].u < largest - 0.5;
      if (behind_seam) corner.texture = next_turn(mesh, shifted, corner.vertex);
    }
  }
}

void write_obj(const Mesh& mesh, const std::filesystem::path& file, const std::string& marker) {
  std::string text = "# " + marker + "\n";
  text.reserve(mesh.positions.size() * 80 + mesh.triangles.size() * 48);
  append_vectors(text, "v", mesh.positions);
  append_vectors(text, "vn", mesh.normals);
  for (const auto& coordinate : mesh.texture_coordinates) {
    text += "vt";
    append_number(text, coordinate.u);
    append_number(text, coordinate.v);
    text.push_back('\n');
  }
  for (const auto& triangle : mesh.triangles) append_triangle(text, triangle);
  replace_file(file, text);
}

}  // namespace facet::generate
