// The light tree from first principles: its bounds hold what they say, what can light a point has a
// probability, and the probabilities are those with which sources are chosen.
#include "scene/emitter/light_tree.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "reference/emitter/light_tree.h"
#include "shared/records.h"
#include "statistics/pearson.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

using reference::LightChooser;
using Receiver = reference::Receiver<double>;

/// A triangle with its normal, and what it makes as a source.
struct Lamp {
  std::array<vec3, 3> corners{};
  dvec3 normal{0};
  LightSource source;
};

class LightTreeTest : public testing::Test {
 protected:
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  dvec3 point(double size) {
    return {number(-size, size), number(-size, size), number(-size, size)};
  }
  dvec3 direction() {
    for (;;) {
      const dvec3 d = point(1);
      if (glm::length(d) > 0.1 && glm::length(d) < 1) return glm::normalize(d);
    }
  }

  Lamp lamp(std::uint32_t mesh, const dvec3& at, double size) {
    Lamp l;
    for (vec3& c : l.corners) c = vec3(at + point(size));
    l.normal = glm::normalize(glm::cross(dvec3(l.corners[1]) - dvec3(l.corners[0]),
                                         dvec3(l.corners[2]) - dvec3(l.corners[0])));
    l.source = piece_source(make_mesh({l.corners.begin(), l.corners.end()}), 0, 1);
    l.source.energy = number(0.01, 5);
    l.source.mesh = mesh;
    return l;
  }

  /// Lamps in clusters, of several meshes; some alone.
  std::vector<Lamp> lamps(std::size_t clusters, std::size_t each) {
    std::vector<Lamp> list;
    for (std::size_t c = 0; c < clusters; ++c) {
      const dvec3 centre = point(3);
      for (std::size_t i = 0; i < each; ++i)
        list.push_back(lamp(static_cast<std::uint32_t>(c), centre + point(0.3), 0.05));
    }
    return list;
  }

  static std::vector<LightSource> sources_of(const std::vector<Lamp>& lamps) {
    std::vector<LightSource> sources;
    sources.reserve(lamps.size());
    for (const Lamp& l : lamps) sources.push_back(l.source);
    return sources;
  }

  Receiver receiver(bool with_normal = true) {
    return {point(4), with_normal ? direction() : dvec3(0)};
  }

  std::uint32_t word() { return static_cast<std::uint32_t>(random_()); }

  std::mt19937 random_{20261127};
};

/// The sources below a node.
std::vector<std::uint32_t> below(const LightTree& tree, std::uint32_t n) {
  const LightTree::Node& node = tree.nodes[n];
  if (node.is_leaf())
    return {tree.order.begin() + node.first, tree.order.begin() + node.first + node.count};
  std::vector<std::uint32_t> list = below(tree, node.first);
  const std::vector<std::uint32_t> second = below(tree, node.first + 1);
  list.insert(list.end(), second.begin(), second.end());
  return list;
}

double angle_between(const dvec3& a, const dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// A mesh shines to the side of its shading normals: they count as the geometric one does.
TEST_F(LightTreeTest, a_source_holds_all_normals_of_its_triangles) {
  for (int i = 0; i < 200; ++i) {
    Mesh mesh = make_mesh({vec3(point(1)), vec3(point(1)), vec3(point(1))});
    const auto [a, b, c] = triangle_corners(mesh, 0);
    const dvec3 geometric = glm::normalize(glm::cross(dvec3(b) - dvec3(a), dvec3(c) - dvec3(a)));
    const double bend = i < 100 ? 0.5 : 3;
    for (int k = 0; k < 3; ++k)
      mesh.normals.emplace_back(glm::normalize(geometric + bend * direction()));
    mesh.normal_indices = {uvec3(0, 1, 2)};
    const LightSource source = piece_source(mesh, 0, 1);
    const double half_angle = std::acos(source.cosine);
    EXPECT_LE(angle_between(source.axis, geometric), half_angle + 1e-6);
    for (const vec3& n : mesh.normals)
      EXPECT_LE(angle_between(source.axis, dvec3(n)), half_angle + 1e-6);
    if (i < 100) {
      EXPECT_GT(source.cosine, 0) << "half of a unit turns no normal by more than 30 degrees";
    }
  }
}

TEST_F(LightTreeTest, every_node_holds_what_lies_below_it) {
  const std::vector<Lamp> all = lamps(9, 40);
  const LightTree tree = build_light_tree(sources_of(all));
  EXPECT_EQ(below(tree, 0).size(), all.size());
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const LightTree::Node& node = tree.nodes[n];
    double energy = 0;
    for (const std::uint32_t s : below(tree, n)) {
      energy += all[s].source.energy;
      for (const vec3& c : all[s].corners)
        EXPECT_LE(glm::length(dvec3(c) - dvec3(node.center)), node.radius) << n;
      // The slack of the importance's cosines covers the rounding of the cone.
      EXPECT_LE(angle_between(dvec3(node.axis), all[s].normal),
                std::acos(std::clamp(node.cosine, -1.0F, 1.0F)) + 2e-3)
          << n;
    }
    EXPECT_NEAR(node.energy, energy / tree.energy, 1e-6);
    if (n > 0) {
      const std::uint32_t sibling = n % 2 == 1 ? n + 1 : n - 1;
      EXPECT_EQ(tree.nodes[sibling].parent, node.parent);
      EXPECT_EQ(tree.nodes[node.parent].first, std::min(n, sibling));
    }
    if (node.is_leaf() && node.count > 1) {
      for (const std::uint32_t s : below(tree, n))
        EXPECT_EQ(all[s].source.mesh, all[tree.order[node.first]].source.mesh);
    }
  }
}

TEST_F(LightTreeTest, whatever_can_light_a_point_has_a_probability) {
  const std::vector<Lamp> all = lamps(7, 25);
  const std::vector<double> weights(all.size(), 1);
  const LightChooser chooser(sources_of(all), weights);
  reference::Unwatched probe;
  for (int i = 0; i < 300; ++i) {
    const Receiver at = receiver(i % 3 != 0);
    double sum = 0;
    for (std::size_t s = 0; s < all.size(); ++s) {
      const double p = chooser.probability(s, at, probe);
      sum += p;
      bool lights = false;
      for (const vec3& c : all[s].corners) {
        const dvec3 way = dvec3(c) - at.point;
        const bool faces = glm::dot(way, all[s].normal) < 0;
        const bool seen = at.normal == dvec3(0) || glm::dot(way, at.normal) > 0;
        lights = lights || (faces && seen);
      }
      if (lights) {
        EXPECT_GT(p, 0) << "receiver " << i << ", source " << s;
      }
    }
    // Less where a group seems to light the point, and none of it does.
    EXPECT_LE(sum, 1 + 1e-9) << i;
  }
}

TEST_F(LightTreeTest, sources_are_chosen_as_often_as_their_probability_says) {
  const std::vector<Lamp> all = lamps(4, 10);
  std::vector<double> weights;
  weights.reserve(all.size());
  for (const Lamp& l : all) weights.push_back(l.source.energy);
  const LightChooser chooser(sources_of(all), weights);
  reference::Unwatched probe;
  constexpr int receivers = 20;
  constexpr int draws = 40000;
  for (int i = 0; i < receivers; ++i) {
    const Receiver at = receiver();
    std::vector<statistics::Count> counts(all.size() + 1);
    for (int k = 0; k < draws; ++k) {
      const auto chosen = chooser.choose(at, word(), word(), word(), probe);
      counts[chosen.probability > 0 ? chosen.source : all.size()].observed += 1;
      if (chosen.probability > 0) {
        EXPECT_NEAR(chosen.probability, chooser.probability(chosen.source, at, probe),
                    1e-12 * chosen.probability);
      }
    }
    double sum = 0;
    for (std::size_t s = 0; s < all.size(); ++s) {
      counts[s].expected = draws * chooser.probability(s, at, probe);
      sum += counts[s].expected;
    }
    counts.back().expected = draws - sum;
    const statistics::Pearson pearson(counts, 5, 0);
    EXPECT_FALSE(pearson.has_impossible()) << i;
    EXPECT_GT(pearson.p_value(), 0.01 / receivers) << i;
  }
}

// The remainder is a number like any other: its parts are as frequent as they are long.
TEST_F(LightTreeTest, what_a_choice_leaves_is_uniform) {
  const std::vector<Lamp> all = lamps(4, 10);
  const std::vector<double> weights(all.size(), 1);
  const LightChooser chooser(sources_of(all), weights);
  reference::Unwatched probe;
  const Receiver at{dvec3(0), dvec3(0)};
  constexpr int draws = 200000;
  std::vector<statistics::Count> counts(64);
  double total = 0;
  for (int k = 0; k < draws; ++k) {
    const auto chosen = chooser.choose(at, word(), word(), word(), probe);
    if (!(chosen.probability > 0)) continue;
    counts[chosen.remainder >> 26U].observed += 1;
    ++total;
  }
  for (statistics::Count& count : counts) count.expected = total / 64;
  EXPECT_GT(statistics::Pearson(counts, 5).p_value(), 0.01);
}

TEST_F(LightTreeTest, point_lights_have_leaves_of_their_own) {
  std::vector<Lamp> all = lamps(1, 5);
  for (int i = 0; i < 6; ++i) {
    Lamp l;
    l.source.box.add(vec3(1, 1, 1));
    l.source.energy = 1;
    all.push_back(l);
  }
  const LightTree tree = build_light_tree(sources_of(all));
  for (const LightTree::Node& node : tree.nodes) {
    if (node.is_leaf() && all[tree.order[node.first]].source.mesh == none) {
      EXPECT_EQ(node.count, 1U);
    }
  }
}

/// Levels below the root.
std::size_t depth_of(const LightTree& tree) {
  std::size_t deepest = 0;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    std::size_t depth = 0;
    for (std::uint32_t k = n; k != 0; k = tree.nodes[k].parent) ++depth;
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

TEST_F(LightTreeTest, stays_shallow_for_whatever_lies_together) {
  std::vector<LightSource> sources;
  // Each twice as far away as the one before; then many in one place.
  for (int i = -60; i < 60; ++i) {
    LightSource s;
    s.box.add(vec3(std::ldexp(1.0F, i), 0, 0));
    s.energy = std::ldexp(1.0, -i);
    sources.push_back(s);
  }
  for (int i = 0; i < 100000; ++i) {
    LightSource s;
    s.box.add(vec3(1, 2, 3));
    s.energy = 1;
    sources.push_back(s);
  }
  const LightTree tree = build_light_tree(sources);
  EXPECT_LE(depth_of(tree), shared::LIGHT_TREE_DEPTH);
  EXPECT_EQ(below(tree, 0).size(), sources.size());
}

}  // namespace
}  // namespace facet::test
