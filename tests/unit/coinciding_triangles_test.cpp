// Triangles that lie in one another, and those that merely touch.
#include "accel/coinciding_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace facet {

namespace {

constexpr TriangleCorners lower{vec3(0, 0, 1), vec3(1, 0, 1), vec3(1, 1, 1)};
constexpr TriangleCorners upper{vec3(0, 0, 1), vec3(1, 1, 1), vec3(0, 1, 1)};

TriangleCorners moved(TriangleCorners triangle, const vec3& by) {
  for (vec3& corner : triangle) corner += by;
  return triangle;
}

void expect_coincide(const TriangleCorners& a, const TriangleCorners& b, bool expected) {
  EXPECT_EQ(coincide(a, b), expected);
  EXPECT_EQ(coincide(b, a), expected);
  EXPECT_EQ(coincide({a[2], a[1], a[0]}, b), expected) << "seen from behind";
}

TEST(CoincidingTriangles, ThemselvesAndThoseThatOverlap) {
  expect_coincide(lower, lower, true);
  expect_coincide(lower, moved(lower, {0.3F, 0.1F, 0}), true);
  expect_coincide(lower, {vec3(-9, -9, 1), vec3(9, -9, 1), vec3(0, 9, 1)}, true);
  // A small one in the corner of a large one.
  expect_coincide(lower, {vec3(0.98F, 0.01F, 1), vec3(0.99F, 0.01F, 1), vec3(0.99F, 0.02F, 1)},
                  true);
}

TEST(CoincidingTriangles, NeighboursDoNot) {
  expect_coincide(lower, upper, false);
  expect_coincide(lower, moved(lower, {1, 0, 0}), false);
  expect_coincide(lower, moved(lower, {1, 1, 0}), false);
  expect_coincide(lower, moved(lower, {5, 0, 0}), false);
}

/// A ray's origin is moved off a surface by 16 * 2^-24 of its largest coordinate, here 1.
TEST(CoincidingTriangles, TheDistanceThatRaysAreMovedCounts) {
  expect_coincide(lower, moved(lower, {0, 0, 31 * 0x1p-24F}), true);
  expect_coincide(lower, moved(lower, {0, 0, 34 * 0x1p-24F}), false);
  const vec3 far(1000, 0, 0);
  expect_coincide(moved(lower, far), moved(lower, far + vec3(0, 0, 0x1p-10F)), true);
  expect_coincide(moved(lower, far), moved(lower, far + vec3(0, 0, 0x1p-8F)), false);
}

TEST(CoincidingTriangles, PlanesThatCrossDoNot) {
  expect_coincide(lower, {vec3(0, 0, 1), vec3(1, 0, 1), vec3(1, 1, 1.001F)}, false);
  expect_coincide(lower, {vec3(0, 0.2F, 0.5F), vec3(1, 0.2F, 0.5F), vec3(1, 0.2F, 2)}, false);
}

TEST(CoincidingTriangles, ThoseWithoutAreaDoNot) {
  expect_coincide(lower, {vec3(0, 0, 1), vec3(0, 0, 1), vec3(1, 1, 1)}, false);
  expect_coincide(lower, {vec3(0.2F, 0.1F, 1), vec3(0.2F, 0.1F, 1), vec3(0.2F, 0.1F, 1)}, false);
}

/// Triangles of a tilted plane and of others that cross it, found by the tree and one by one.
TEST(CoincidingTriangles, TheTreeFindsAllOfThem) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> whole(-8, 8);
  const auto draw = [&](bool in_plane) {
    TriangleCorners triangle{};
    for (vec3& corner : triangle) {
      const auto x = static_cast<float>(whole(random));
      const auto y = static_cast<float>(whole(random));
      corner = {x, y, in_plane ? 2 * x - y : static_cast<float>(whole(random))};
    }
    return triangle;
  };
  std::vector<TriangleCorners> triangles;
  for (int i = 0; i < 200; ++i) triangles.push_back(draw(i % 2 == 0));
  const CoincidenceFinder finder(triangles);
  std::size_t count = 0;
  for (int i = 0; i < 200; ++i) {
    const TriangleCorners other = draw(i % 2 == 0);
    std::vector<std::size_t> found;
    finder.find(other, 1000, [&](std::size_t k) { found.push_back(k); });
    std::sort(found.begin(), found.end());
    std::vector<std::size_t> expected;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      if (coincide(triangles[k], other)) expected.push_back(k);
    }
    EXPECT_EQ(found, expected);
    count += found.size();
  }
  EXPECT_GT(count, 1000U);
  CoincidenceFinder({}).find(lower, 1000, [](std::size_t /*k*/) { ADD_FAILURE(); });
}

}  // namespace

}  // namespace facet
