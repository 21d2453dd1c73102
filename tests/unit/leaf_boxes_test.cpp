// Where very many boxes overlap they are divided; elsewhere they are not.
#include "accel/leaf_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace facet::test {
namespace {

using Triangles = std::vector<TriangleCorners>;

/// Boxes of a set of triangles, first each in one and then divided.
struct Divided {
  Triangles triangles;
  std::vector<TrianglePair> pairs;
  LeafBoxes whole;
  LeafBoxes boxes;

  explicit Divided(Triangles t, std::size_t most_copies = 10'000'000)
      : triangles(std::move(t)),
        pairs(pair_triangles(triangles)),
        whole(make_leaf_boxes(pairs, triangles)) {
    boxes = divide_crowded(BinaryBvh(whole.primitives), pairs, triangles, most_copies);
  }

  /// How many boxes hold a point.
  static std::size_t count_at(const LeafBoxes& boxes, const vec3& point) {
    return static_cast<std::size_t>(std::count_if(
        boxes.primitives.begin(), boxes.primitives.end(), [&](const BvhPrimitive& primitive) {
          const Box box = primitive.box().box();
          return glm::all(glm::lessThanEqual(box.lower, point)) &&
                 glm::all(glm::lessThanEqual(point, box.upper));
        }));
  }
};

/// Needles from one point in a plane.
Triangles make_fan(int count) {
  const auto at = [&](int i) {
    const double phi = 6.283185307179586 * i / count;
    return vec3(std::cos(phi), std::sin(phi), 0);
  };
  Triangles triangles;
  for (int i = 0; i < count; ++i) triangles.push_back({vec3(0), at(i), at(i + 1)});
  return triangles;
}

/// Needles from one point in all directions.
Triangles make_urchin(int count) {
  std::mt19937 engine(3);
  std::normal_distribution<float> normal;
  Triangles triangles;
  for (int i = 0; i < count; ++i) {
    const vec3 tip = glm::normalize(vec3(normal(engine), normal(engine), normal(engine)));
    triangles.push_back(
        {vec3(0), tip, tip + 1e-3F * vec3(normal(engine), normal(engine), normal(engine))});
  }
  return triangles;
}

TEST(LeafBoxes, OfFansFollowTheirTriangles) {
  const Divided fan(make_fan(100'000));
  ASSERT_FALSE(fan.boxes.copies.empty());
  EXPECT_EQ(fan.boxes.primitives.size(), fan.pairs.size() + fan.boxes.copies.size());
  EXPECT_LE(fan.boxes.primitives.size(), 48 * fan.pairs.size());
  for (const vec3& point : {vec3(0.5F, 0.4F, 0), vec3(-0.1F, 0.1F, 0), vec3(0.03F, -0.02F, 0)}) {
    EXPECT_GT(Divided::count_at(fan.whole, point), 5000U);
    EXPECT_LT(Divided::count_at(fan.boxes, point), 2600U);
  }
}

TEST(LeafBoxes, OfUrchinsFollowTheirTriangles) {
  const Divided urchin(make_urchin(100'000));
  ASSERT_FALSE(urchin.boxes.copies.empty());
  for (const vec3& point : {vec3(0.5F, 0.4F, 0.3F), vec3(-0.3F, 0.3F, 0.3F)})
    EXPECT_LT(2 * Divided::count_at(urchin.boxes, point), Divided::count_at(urchin.whole, point));
}

/// What a ray hits must lie in a box of its pair: points of every triangle, corners included, do.
TEST(LeafBoxes, CoverEveryPointOfEveryTriangle) {
  for (const Triangles& triangles : {make_fan(20'000), make_urchin(20'000)}) {
    const Divided divided(triangles);
    std::vector<std::vector<Box>> boxes(divided.pairs.size());
    for (const BvhPrimitive& primitive : divided.boxes.primitives)
      boxes[divided.boxes.pair_of(primitive.index())].push_back(primitive.box().box());
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (std::size_t i = 0; i < divided.pairs.size(); ++i) {
      for (const std::uint32_t t : {divided.pairs[i].first, divided.pairs[i].second}) {
        if (t == none) continue;
        for (int k = 0; k < 40; ++k) {
          // The corners first.
          const double u = k < 3 ? std::min(k, 1) : std::sqrt(uniform(engine));
          const double v = k < 3 ? k / 2 : uniform(engine);
          const vec3 point(dvec3(triangles[t][0]) * (1 - u) +
                           dvec3(triangles[t][1]) * (u * (1 - v)) +
                           dvec3(triangles[t][2]) * (u * v));
          EXPECT_TRUE(std::any_of(boxes[i].begin(), boxes[i].end(),
                                  [&](const Box& box) {
                                    return glm::all(glm::lessThanEqual(box.lower, point)) &&
                                           glm::all(glm::lessThanEqual(point, box.upper));
                                  }))
              << point.x << ' ' << point.y << ' ' << point.z;
        }
      }
    }
  }
}

TEST(LeafBoxes, OfOrdinaryMeshesAndOfWhatCannotBeDividedStayWhole) {
  Triangles field;
  for (int i = 0; i < 200; ++i) {
    for (int k = 0; k < 200; ++k) {
      const vec3 p(static_cast<float>(i), static_cast<float>(k),
                   std::sin(0.1F * static_cast<float>(i * k)));
      field.push_back({p, p + vec3(1, 0, 0), p + vec3(0, 1, 0)});
    }
  }
  EXPECT_TRUE(Divided(field).boxes.copies.empty());
  // Squares in one another.
  Triangles stack;
  for (int i = 0; i < 6000; ++i) {
    stack.push_back({vec3(0, 0, 0), vec3(1, 0, 0), vec3(1, 1, 0)});
    stack.push_back({vec3(0, 0, 0), vec3(1, 1, 0), vec3(0, 1, 0)});
  }
  EXPECT_TRUE(Divided(stack).boxes.copies.empty());
}

TEST(LeafBoxes, AreNoMoreThanThereIsRoomFor) {
  EXPECT_TRUE(Divided(make_fan(20'000), 0).boxes.copies.empty());
  const std::size_t copies = Divided(make_fan(20'000), 30'000).boxes.copies.size();
  EXPECT_GT(copies, 10'000U);
  EXPECT_LE(copies, 30'000U);
}

TEST(LeafBoxes, AreTheSameEveryTime) {
  const Divided first(make_urchin(20'000));
  const Divided second(make_urchin(20'000));
  ASSERT_EQ(first.boxes.copies, second.boxes.copies);
  for (std::size_t i = 0; i < first.boxes.primitives.size(); ++i) {
    EXPECT_EQ(first.boxes.primitives[i].index(), second.boxes.primitives[i].index());
    EXPECT_EQ(first.boxes.primitives[i].box().box().lower,
              second.boxes.primitives[i].box().box().lower);
  }
}

}  // namespace
}  // namespace facet::test
