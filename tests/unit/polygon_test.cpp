// Polygons of OBJ files: their triangles cover them, whatever their shape, at once.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <map>
#include <numbers>
#include <random>

#include "support/obj.h"

namespace facet {

namespace {

using test::area;
using test::square;

class PolygonTest : public test::ObjTest {};

TEST_F(PolygonTest, PolygonsAreTriangulated) {
  const Mesh quad = read(square + "f 1 2 3 4\n");
  EXPECT_EQ(quad.position_indices.size(), 2U);
  EXPECT_NEAR(area(quad), 1, 1e-6);
  const Mesh pentagon = read(square + "v -1 0.5 0\nf 1 2 3 4 5\n");
  EXPECT_EQ(pentagon.position_indices.size(), 3U);
  EXPECT_NEAR(area(pentagon), 1.5, 1e-6);
}

TEST_F(PolygonTest, ConcavePolygonsKeepTheirArea) {
  const Mesh arrow = read("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\nf 1 2 3 4 5\n");
  EXPECT_EQ(arrow.position_indices.size(), 3U);
  EXPECT_NEAR(area(arrow), 2.5, 1e-6);
}

TEST_F(PolygonTest, QuadrilateralsAreCutAlongTheShorterDiagonalThatLiesInThem) {
  const Mesh kite = read("v 0 0 0\nv 1 -1 0\nv 3 0 0\nv 1 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(kite.position_indices, (std::vector<uvec3>{{0, 1, 3}, {1, 2, 3}}));
  const Mesh dart = read("v 0 10 0\nv -1 0 0\nv 0 5 0\nv 1 0 0\nf 1 2 3 4\nf 2 3 4 1\n");
  EXPECT_EQ(dart.position_indices.size(), 4U);
  EXPECT_NEAR(area(dart), 2 * 5, 1e-5);
}

TEST_F(PolygonTest, PolygonsThatWindInwardsKeepTheirArea) {
  // A comb of three teeth, in a plane across the axes.
  const std::array<vec2, 11> outline{vec2(0, 0), vec2(5, 0), vec2(5, 4), vec2(4, 4),
                                     vec2(4, 1), vec2(3, 1), vec2(3, 4), vec2(2, 4),
                                     vec2(2, 1), vec2(1, 1), vec2(0, 4)};
  std::string text;
  std::string face = "f";
  for (std::size_t i = 0; i < outline.size(); ++i) {
    text += fmt::format("v {} {} {}\n", outline[i].x, outline[i].y, outline[i].x);
    face += fmt::format(" {}", i + 1);
  }
  const Mesh comb = read(text + face + "\n");
  EXPECT_EQ(comb.position_indices.size(), 9U);
  EXPECT_NEAR(area(comb), (5 + 3 + 3 + 1.5) * std::numbers::sqrt2, 1e-5);
}

TEST_F(PolygonTest, PolygonsOfAnySizeKeepTheirShape) {
  // Differences of the largest coordinates overflow a float; a notch, not to be filled.
  const std::string text =
      "v -3e38 -3e38 0\nv 3e38 -3e38 0\nv 3e38 3e38 0\nv 0 2e38 0\nv -3e38 3e38 0\nf 1 2 3 4 5\n";
  EXPECT_NEAR(area(read(text, glm::scale(dmat4(1), dvec3(1e-38)))), 36 - 3, 1e-5);
}

TEST_F(PolygonTest, PolygonsMayHaveHolesBehindASlit) {
  // A square of side 3 with a square hole of side 1; two corners are met twice.
  const Mesh frame = read(
      "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 1 1 0\nv 1 2 0\nv 2 2 0\nv 2 1 0\n"
      "f 1 2 3 4 1 5 6 7 8 5\n");
  EXPECT_EQ(frame.position_indices.size(), 8U);
  EXPECT_NEAR(area(frame), 8, 1e-5);
}

TEST_F(PolygonTest, CornersAtOnePlaceCountOnce) {
  // A dart, as in the quadrilaterals above, of area 3.
  const std::string dart = "v 0 3 0\nv -2 0 0\nv 0 1.5 0\nv 2 0 0\n";
  for (const char* face : {"f 1 2 3 4", "f 1 2 2 3 4 4", "f 1 1 2 3 4", "f 1 2 3 4 1",
                           "f 4 1 2 3 3 3 4", "f 1 2 3 3 4 4 1 1"}) {
    const Mesh mesh = read(dart + face + "\n");
    EXPECT_EQ(mesh.position_indices.size(), 2U) << face;
    EXPECT_NEAR(area(mesh), 3, 1e-6) << face;
  }
  // At one place by their coordinates, not by their indices.
  EXPECT_NEAR(area(read(dart + "v -2 0 0\nv -2 -0 0\nf 1 2 5 6 3 4\n")), 3, 1e-6);
  EXPECT_EQ(read(square + "f 1 1 2 2\nf 1 1 1 1 1\nf 1 2 3 3\n").position_indices.size(), 1U);
}

/// f 1 2 3 ... behind vertices in the plane x + z = 0.
std::string polygon_of(const std::vector<dvec2>& corners) {
  std::string text;
  std::string face = "f";
  for (std::size_t i = 0; i < corners.size(); ++i) {
    text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", corners[i].x, corners[i].y, -corners[i].x);
    face += fmt::format(" {}", i + 1);
  }
  return text + face + "\n";
}

/// By the shoelace formula, in the plane of polygon_of.
double area_of(const std::vector<dvec2>& corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dvec2& a = corners[i];
    const dvec2& b = corners[(i + 1) % corners.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2 * std::numbers::sqrt2;
}

/// A quadratic method would take minutes for each.
TEST_F(PolygonTest, PolygonsOfVeryManyCornersTakeNoTime) {
  constexpr int count = 200'000;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::map<std::string, std::vector<dvec2>> polygons;
  const auto on_circle = [](double turns, double radius) {
    return dvec2(radius * std::cos(2 * std::numbers::pi * turns),
                 radius * std::sin(2 * std::numbers::pi * turns));
  };
  for (int i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / count;
    polygons["circle"].push_back(on_circle(t, 1));
    polygons["star"].push_back(on_circle(t, i % 2 == 0 ? 1 : 0.5));
    polygons["rugged star"].push_back(on_circle(t, 0.5 + 0.5 * uniform(random)));
    polygons["comb"].emplace_back(i, i == 0 || i == count - 1 ? 0 : (i % 2 == 0 ? 1 : 100));
    // Out along a spiral and back beside it.
    const double along = i < count / 2 ? 2 * t : 2 - 2 * t;
    polygons["spiral"].push_back(on_circle(20 * along, 1 + 20 * along + (i < count / 2 ? 0 : 0.5)));
  }
  for (const auto& [name, corners] : polygons) {
    const Mesh mesh = read(polygon_of(corners));
    EXPECT_EQ(mesh.position_indices.size(), corners.size() - 2) << name;
    EXPECT_NEAR(area(mesh) / area_of(corners), 1, 1e-4) << name;
  }
}

/// They have no triangulation that is right; what is asked for is an end.
TEST_F(PolygonTest, PolygonsThatAreNoneTakeNoTimeEither) {
  constexpr int count = 100'000;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<dvec2> line;
  std::vector<dvec2> tangle;
  std::vector<dvec2> comb_of_slits;
  for (int i = 0; i < count; ++i) {
    line.emplace_back(i, 0);
    tangle.emplace_back(uniform(random), uniform(random));
    comb_of_slits.emplace_back(i / 2, i % 2);
  }
  EXPECT_EQ(area(read(polygon_of(line))), 0);
  for (const auto& corners : {line, tangle, comb_of_slits})
    EXPECT_EQ(read(polygon_of(corners)).position_indices.size(), corners.size() - 2);
}

TEST_F(PolygonTest, TrianglesOfAPolygonKeepItsOrientation) {
  const Mesh mesh = read(square + "v -1 0.5 0\nf 1 2 3 4 5\nf 4 3 2 1\n");
  ASSERT_EQ(mesh.position_indices.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const uvec3 t = mesh.position_indices[i];
    const vec3 a = mesh.positions[t.x];
    const float z = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a).z;
    EXPECT_GT(i < 3 ? z : -z, 0) << "triangle " << i;
  }
}

}  // namespace

}  // namespace facet
