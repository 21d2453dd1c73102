// What the acceleration structure is made of, on the host: pairs of triangles, and nodes of four
// children.
#include "accel/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "accel/wide_tree.h"

namespace facet::test {
namespace {

using Triangles = std::vector<TriangleCorners>;

/// A field of cells x cells squares of two triangles each, with hills.
Triangles make_field(int cells) {
  const auto vertex = [](int x, int y) {
    const auto u = static_cast<float>(x);
    const auto v = static_cast<float>(y);
    return vec3(u, v, 2 * std::sin(0.3F * u) * std::cos(0.2F * v));
  };
  Triangles triangles;
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      triangles.push_back({vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1)});
      triangles.push_back({vertex(x, y), vertex(x + 1, y + 1), vertex(x, y + 1)});
    }
  }
  return triangles;
}

Triangles make_soup(int count) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> uniform(-1, 1);
  Triangles triangles(static_cast<std::size_t>(count));
  for (TriangleCorners& triangle : triangles) {
    for (vec3& corner : triangle) {
      for (int a = 0; a < 3; ++a) corner[a] = uniform(engine);
    }
  }
  return triangles;
}

/// Triangles about one edge, like the pages of a book.
Triangles make_book(int pages) {
  Triangles triangles;
  for (int i = 0; i < pages; ++i) {
    const float phi = 6.28F * static_cast<float>(i) / static_cast<float>(pages);
    triangles.push_back({vec3(0, 0, 0), vec3(std::cos(phi), std::sin(phi), 0.5F), vec3(0, 0, 1)});
  }
  return triangles;
}

float box_area(const Triangles& triangles, std::initializer_list<std::uint32_t> which) {
  Box box;
  for (const std::uint32_t i : which) box.add(bounds_of(triangles[i]));
  return box.half_area();
}

/// The share of the triangles that found a partner.
double share_joined(const Triangles& triangles) {
  std::vector<int> times(triangles.size());
  double joined = 0;
  for (const TrianglePair& pair : pair_triangles(triangles)) {
    ++times[pair.first];
    if (pair.second == none) continue;
    ++times[pair.second];
    joined += 2;
    const TriangleCorners& p = triangles[pair.first];
    const TriangleCorners& q = triangles[pair.second];
    for (std::size_t k = 0; k < 3; ++k) {
      // Corners 2 and 0 of the first are the second's that are not its apex.
      EXPECT_EQ(std::ranges::count(q, p[(pair.turn + k) % 3]), k == 1 ? 0 : 1);
    }
    EXPECT_EQ(std::ranges::count(p, q[pair.apex]), 0);
    EXPECT_LE(box_area(triangles, {pair.first, pair.second}),
              box_area(triangles, {pair.first}) + box_area(triangles, {pair.second}));
  }
  EXPECT_TRUE(std::ranges::all_of(times, [](int t) { return t == 1; }));
  return joined / static_cast<double>(triangles.size());
}

TEST(TrianglePairs, neighbours_in_the_file_are_joined) {
  EXPECT_EQ(share_joined(make_field(40)), 1);
}

TEST(TrianglePairs, neighbours_in_space_are_joined_whatever_their_order) {
  Triangles triangles = make_field(40);
  std::ranges::shuffle(triangles, std::mt19937(3));
  EXPECT_GE(share_joined(triangles), 0.85);
}

TEST(TrianglePairs, strangers_are_not_joined) { EXPECT_EQ(share_joined(make_soup(500)), 0); }

TEST(TrianglePairs, an_edge_of_very_many_triangles_takes_no_time) {
  // Quadratic time would be hours.
  EXPECT_GT(share_joined(make_book(1'000'000)), 0.5);
}

TEST(TrianglePairs, long_triangles_that_fill_a_large_box_together_stay_apart) {
  // Along two edges of a square: neither is in the other's box.
  const Triangles triangles{{vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 0, 0.01F)},
                            {vec3(0, 0, 0), vec3(0, 0, 0.01F), vec3(0, 1, 0)}};
  EXPECT_EQ(share_joined(triangles), 0);
}

TEST(Bvh, zeros_of_both_signs_are_one) {
  // Of both, the least would depend on their order, which threads change: all become positive.
  const Triangles floor{{vec3(0, -0.0F, 0), vec3(1, -0.0F, 0), vec3(0, -0.0F, 1)},
                        {vec3(5, -0.0F, 5), vec3(6, -0.0F, 5), vec3(5, -0.0F, 6)}};
  const Bvh bvh = build_bvh(floor);
  EXPECT_FALSE(std::signbit(bvh.bounds.lower.y));
  EXPECT_FALSE(std::signbit(bvh.bounds.upper.y));
}

TEST(Bvh, gives_back_every_triangle_at_its_place_in_the_order_of_its_vertices) {
  // The last is large enough to be built on all cores.
  for (Triangles triangles : {make_field(20), make_soup(300), make_book(50), make_field(300)}) {
    std::mt19937 engine(5);
    for (TriangleCorners& triangle : triangles) std::ranges::shuffle(triangle, engine);
    const Bvh bvh = build_bvh(triangles);
    ASSERT_EQ(bvh.places.size(), triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i)
      EXPECT_EQ(triangle_at(bvh.places[i], bvh.items, bvh.pairs), triangles[i]);
    std::vector<std::uint32_t> places(bvh.places.begin(), bvh.places.end());
    std::ranges::sort(places);
    EXPECT_EQ(std::ranges::adjacent_find(places), places.end());
  }
}

TEST(Bvh, of_coordinates_whose_sums_overflow_holds_every_triangle) {
  Triangles triangles = make_soup(300);
  for (TriangleCorners& triangle : triangles) {
    for (vec3& corner : triangle) corner *= 3e38F;
  }
  const Bvh bvh = build_bvh(triangles);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    EXPECT_EQ(triangle_at(bvh.places[i], bvh.items, bvh.pairs), triangles[i]);
}

BinaryBvh random_tree(std::uint32_t seed, std::uint32_t leaves) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  UnfilledVector<BvhPrimitive> primitives;
  for (std::uint32_t i = 0; i < leaves; ++i) {
    const vec3 centre(uniform(engine), uniform(engine), uniform(engine));
    const vec3 reach = vec3(0.3F, 0.2F, 0.05F) * (1 + uniform(engine));
    primitives.emplace_back(Box{centre - 0.3F, centre + reach}, i);
  }
  return BinaryBvh(std::move(primitives));
}

/// Half areas of the wide nodes over a binary one.
double area_of(const BinaryBvh& binary, const WideTree& wide, BinaryBvh::Node node) {
  if (BinaryBvh::is_leaf(node)) return 0;
  double area = binary.box(node).half_area();
  const Children children = wide.children_of(node);
  for (std::uint32_t c = 0; c < children.count; ++c)
    area += area_of(binary, wide, children.nodes[c]);
  return area;
}

/// The smallest that they can be, found by trying every way to open a node's children.
class EveryWay {
 public:
  explicit EveryWay(const BinaryBvh& binary) : binary_(binary) {}

  double least_area(BinaryBvh::Node node) {
    if (BinaryBvh::is_leaf(node)) return 0;
    if (const auto known = known_.find(node); known != known_.end()) return known->second;
    return known_[node] = binary_.box(node).half_area() +
                          least_of({binary_.first(node), binary_.second(node)});
  }

 private:
  double least_of(const std::vector<BinaryBvh::Node>& children) {
    double least = 0;
    for (const BinaryBvh::Node c : children) least += least_area(c);
    if (children.size() == 4) return least;
    for (std::size_t k = 0; k < children.size(); ++k) {
      if (BinaryBvh::is_leaf(children[k])) continue;
      std::vector<BinaryBvh::Node> opened = children;
      opened[k] = binary_.first(children[k]);
      opened.push_back(binary_.second(children[k]));
      least = std::min(least, least_of(opened));
    }
    return least;
  }

  const BinaryBvh& binary_;
  std::map<BinaryBvh::Node, double> known_;
};

TEST(WideTree, has_the_smallest_area_of_all_choices) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    const BinaryBvh binary = random_tree(seed, 2 + 3 * seed);
    const double least = EveryWay(binary).least_area(binary.root());
    EXPECT_NEAR(area_of(binary, WideTree(binary), binary.root()), least, 1e-5 * least) << seed;
  }
}

TEST(WideTree, of_boxes_too_large_for_areas_holds_every_leaf) {
  UnfilledVector<BvhPrimitive> primitives;
  for (std::uint32_t i = 0; i < 100; ++i)
    primitives.emplace_back(Box{vec3(-1e30F), vec3(1e30F + 1e28F * static_cast<float>(i))}, i);
  const BinaryBvh binary(std::move(primitives));
  const WideTree wide(binary);
  std::vector<int> times(100);
  std::vector<BinaryBvh::Node> open{binary.root()};
  while (!open.empty()) {
    const Children children = wide.children_of(open.back());
    open.pop_back();
    for (std::uint32_t c = 0; c < children.count; ++c) {
      const BinaryBvh::Node child = children.nodes[c];
      if (BinaryBvh::is_leaf(child)) {
        ++times[binary.primitive(child)];
      } else {
        open.push_back(child);
      }
    }
  }
  EXPECT_TRUE(std::ranges::all_of(times, [](int t) { return t == 1; }));
}

}  // namespace
}  // namespace facet::test
