// What an emitting mesh is sampled by: triangles, and two that make a parallelogram as one.
#include "render/pack/emitter_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "reference/emitter/piece.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

using reference::piece_at;
using reference::PiecePoint;

/// Where a piece has its point (u, v).
dvec3 position(const Mesh& mesh, double u, double v) {
  const PiecePoint<double> at = reference::point_of(piece_at(mesh, 0), u, v);
  const auto corners = triangle_corners(mesh, at.triangle);
  return (1 - at.b1 - at.b2) * dvec3(corners[0]) + at.b1 * dvec3(corners[1]) +
         at.b2 * dvec3(corners[2]);
}

/// A parallelogram of two triangles, each beginning with another of its corners.
Mesh parallelogram(std::size_t first, std::size_t second) {
  std::vector<vec3> one{{0, 0, 0}, {2, 0, 0}, {1, 3, 0}};
  std::vector<vec3> two{{3, 3, 0}, {1, 3, 0}, {2, 0, 0}};
  std::rotate(one.begin(), one.begin() + static_cast<std::ptrdiff_t>(first), one.end());
  std::rotate(two.begin(), two.begin() + static_cast<std::ptrdiff_t>(second), two.end());
  one.insert(one.end(), two.begin(), two.end());
  return make_mesh(one);
}

TEST(EmitterPieces, a_parallelogram_is_sampled_as_one) {
  for (std::size_t first = 0; first < 3; ++first) {
    for (std::size_t second = 0; second < 3; ++second) {
      const Mesh mesh = parallelogram(first, second);
      ASSERT_TRUE(piece_at(mesh, 0).is_pair);
      for (int i = 0; i < 64; ++i) {
        const double u = i % 8 / 8.0;
        const double v = i / 8 / 8.0;  // NOLINT(bugprone-integer-division): the row
        const dvec3 expected = u * dvec3(2, 0, 0) + v * dvec3(1, 3, 0);
        EXPECT_LT(glm::length(position(mesh, u, v) - expected), 1e-12) << u << ' ' << v;
      }
      const std::vector<EmitterPiece> packed = emitter_pieces(mesh);
      EXPECT_EQ(packed[0].weight, 0);
      EXPECT_NEAR(packed[1].weight, 6, 1e-6);
      EXPECT_EQ(packed[0].corner & shared::FIRST_OF_TWO, shared::FIRST_OF_TWO);
      EXPECT_EQ(triangle_corners(mesh, 0).at(packed[0].corner & shared::CORNER_MASK),
                vec3(0, 0, 0));
      EXPECT_EQ(triangle_corners(mesh, 1).at(packed[1].corner), vec3(3, 3, 0));
    }
  }
}

/// How many triangles are sampled by themselves, as the kernels and as the reference see it.
std::array<std::size_t, 2> count_single(const Mesh& mesh) {
  std::array<std::size_t, 2> single{};
  for (const EmitterPiece& piece : emitter_pieces(mesh))
    single[0] += piece.corner == shared::NO_CORNER ? 1 : 0;
  for (std::size_t i = 0; i < mesh.position_indices.size();) {
    const bool pair = piece_at(mesh, i).is_pair;
    single[1] += pair ? 0 : 1;
    i += pair ? 2 : 1;
  }
  return single;
}

TEST(EmitterPieces, only_neighbours_of_one_area_and_winding_are_joined) {
  const vec3 a(0, 0, 0);
  const vec3 b(2, 0, 0);
  const vec3 c(3, 3, 0);
  const vec3 d(1, 3, 0);
  using Counts = std::array<std::size_t, 2>;
  EXPECT_EQ(count_single(make_mesh({a, b, d})), (Counts{1, 1}));
  EXPECT_EQ(count_single(make_mesh({a, b, d, c, d, b})), (Counts{0, 0}));
  EXPECT_EQ(count_single(make_mesh({a, b, d, c, b, d})), (Counts{2, 2})) << "turned over";
  EXPECT_EQ(count_single(make_mesh({a, b, d, {3.01F, 3.01F, 0}, d, b})), (Counts{2, 2}))
      << "larger";
  EXPECT_EQ(count_single(make_mesh({a, b, d, {3.0001F, 3, 0}, d, b})), (Counts{0, 0})) << "nearly";
  EXPECT_EQ(count_single(make_mesh({a, b, d, {3, 3, 1}, {1, 3, 1}, {2, 0, 1}})), (Counts{2, 2}))
      << "no common edge";
  EXPECT_EQ(count_single(make_mesh({a, a, d, d, a, a})), (Counts{2, 2})) << "without area";
  // The third is the first's neighbour, too.
  EXPECT_EQ(count_single(make_mesh({a, b, d, c, d, b, a, d, {-1, 3, 0}})), (Counts{1, 1}));
  const std::array<std::size_t, 2> sphere = count_single(make_sphere(3, false));
  EXPECT_EQ(sphere[0], sphere[1]);
}

// Half of the points lie in each triangle.
TEST(EmitterPieces, points_are_as_dense_in_both_triangles) {
  const Mesh mesh = parallelogram(0, 0);
  constexpr int side = 512;
  std::array<int, 2> count{};
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const auto at = reference::point_of(piece_at(mesh, 0), (i + 0.5) / side, (j + 0.5) / side);
      ++count.at(at.triangle);
    }
  }
  // But for those on the diagonal.
  EXPECT_NEAR(count[0] - count[1], side, 0.5);
}

}  // namespace
}  // namespace facet::test
