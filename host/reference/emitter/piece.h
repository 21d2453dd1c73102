#pragma once
// What an emitting mesh is sampled by: triangles, and pairs of them (docs/reference/sampling.md,
// "Emitter sample").
#include <array>
#include <cmath>

#include "reference/real.h"
#include "scene/scene.h"

namespace facet::reference {

/// A triangle of a mesh, or that and the next one, sampled as one square.
struct EmittingPiece {
  std::size_t first = 0;  ///< index within the mesh
  bool is_pair = false;
  /// Of a pair, each triangle's vertices in the order a, b, d and c, b, d.
  std::array<std::array<int, 3>, 2> order{};

  [[nodiscard]] std::size_t triangle_count() const { return is_pair ? 2 : 1; }
};

/// The piece that begins with a triangle of the mesh.
[[nodiscard]] inline EmittingPiece piece_at(const Mesh& mesh, std::size_t first) {
  EmittingPiece piece{first};
  if (first + 1 >= mesh.position_indices.size()) return piece;
  const double area = triangle_area(mesh, first);
  const double next_area = triangle_area(mesh, first + 1);
  if (!(area > 0 && next_area > 0)) return piece;
  if (std::abs(area - next_area) / std::max(area, next_area) > 0.001) return piece;
  const uvec3& t = mesh.position_indices[first];
  const uvec3& n = mesh.position_indices[first + 1];
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const int d = (a + 2) % 3;
    for (int c = 0; c < 3; ++c) {
      const int after = (c + 1) % 3;
      const int last = (c + 2) % 3;
      if (mesh.positions[t[b]] != mesh.positions[n[last]]) continue;
      if (mesh.positions[t[d]] != mesh.positions[n[after]]) continue;
      piece.is_pair = true;
      piece.order = {{{a, b, d}, {c, last, after}}};
      return piece;
    }
  }
  return piece;
}

/// A point of a triangle of a mesh by the weights of its second and third vertex.
template <typename Real>
struct PiecePoint {
  std::size_t triangle;  ///< index within the mesh
  Real b1;
  Real b2;
};

/// The piece's point (u, v).
template <typename Real>
[[nodiscard]] PiecePoint<Real> point_of(const EmittingPiece& piece, Real u, Real v) {
  if (!piece.is_pair) {
    const Real s = std::sqrt(1 - u);
    return {piece.first, s * (1 - v), s * v};
  }
  const bool in_first = u + v <= 1;
  const std::array<Real, 3> weights =
      in_first ? std::array{1 - u - v, u, v} : std::array{u + v - 1, 1 - v, 1 - u};
  std::array<Real, 3> by_vertex{};
  for (std::size_t k = 0; k < 3; ++k)
    by_vertex.at(static_cast<std::size_t>(piece.order.at(in_first ? 0 : 1).at(k))) = weights.at(k);
  return {piece.first + (in_first ? 0 : 1), by_vertex[1], by_vertex[2]};
}

}  // namespace facet::reference
