#include "scene/emitter/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "shared/records.h"

namespace facet {

namespace {

constexpr double pi = std::numbers::pi;

/// Sources that may share a leaf: so many, in a sphere of this share of their mesh's.
constexpr std::size_t leaf_size = 64;
constexpr double leaf_share = 1.0 / 4;
constexpr std::size_t bin_count = 12;
/// From here on nodes are halved, which needs at most 32 levels more.
constexpr std::size_t level_of_halving = shared::LIGHT_TREE_DEPTH - 32;

/// A cone of directions.
struct Cone {
  dvec3 axis{0, 0, 1};
  double cosine = 2;  ///< of the half angle; above 1: no direction at all

  [[nodiscard]] double angle() const { return std::acos(std::clamp(cosine, -1.0, 1.0)); }
};

/// A cone around two.
Cone around(const Cone& a, const Cone& b) {
  if (b.cosine > 1) return a;
  if (a.cosine > 1) return b;
  if (a.angle() < b.angle()) return around(b, a);
  const double between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0, 1.0));
  if (std::min(between + b.angle(), pi) <= a.angle()) return a;
  const double angle = (a.angle() + between + b.angle()) / 2;
  const dvec3 across = b.axis - glm::dot(a.axis, b.axis) * a.axis;
  if (angle >= pi || !(glm::length(across) > 0)) return {a.axis, -1};
  const double turn = angle - a.angle();
  return {glm::normalize(std::cos(turn) * a.axis + std::sin(turn) * glm::normalize(across)),
          std::cos(angle)};
}

/// What is known of several sources.
struct Emission {
  Box box;
  Cone cone;
  double energy = 0;

  void add(const Emission& other) {
    box.add(other.box);
    cone = around(cone, other.cone);
    energy += other.energy;
  }
};

/// Measure of the directions into which Lambertian emitters with normals of the cone send light.
double measure(const Cone& cone) {
  const double angle = cone.angle();
  const double reach = std::min(angle + pi / 2, pi);
  const double sine = std::sin(angle);
  return 2 * pi * (1 - std::cos(angle)) +
         pi / 2 *
             (2 * reach * sine - std::cos(angle - 2 * reach) - 2 * angle * sine + std::cos(angle));
}

/// How likely light from within the bounds is to be wanted. The box's diagonal tells boxes without
/// area apart.
double cost(const Emission& b) {
  if (b.box.empty()) return 0;
  const dvec3 extent(b.box.extent());
  return b.energy * measure(b.cone) *
         (static_cast<double>(b.box.half_area()) + 1e-3 * glm::dot(extent, extent));
}

double center_of(const LightSource& s, int axis) {
  return (static_cast<double>(s.box.lower[axis]) + static_cast<double>(s.box.upper[axis])) / 2;
}

class LightTreeBuilder {
 public:
  explicit LightTreeBuilder(std::span<const LightSource> sources) : sources_(sources) {
    tree_.order.resize(sources.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0U);
    for (const LightSource& s : sources) {
      tree_.energy += s.energy;
      if (s.mesh != none) meshes_[s.mesh].add(s.box);
    }
  }

  LightTree build() {
    if (sources_.empty()) return {};
    tree_.nodes.emplace_back();
    build_node(0, 0, tree_.order.size(), 0);
    return std::move(tree_);
  }

 private:
  [[nodiscard]] const LightSource& source(std::size_t place) const {
    return sources_[tree_.order[place]];
  }
  [[nodiscard]] Emission emission_of(std::size_t place) const {
    const LightSource& s = source(place);
    return {s.box, {s.axis, s.cosine}, s.energy};
  }

  [[nodiscard]] bool is_leaf(std::size_t begin, std::size_t end, const Box& box) const {
    if (end - begin == 1) return true;
    const std::uint32_t mesh = source(begin).mesh;
    if (end - begin > leaf_size || mesh == none) return false;
    for (std::size_t i = begin; i < end; ++i) {
      if (source(i).mesh != mesh) return false;
    }
    return glm::length(dvec3(box.extent())) <=
           leaf_share * glm::length(dvec3(meshes_.at(mesh).extent()));
  }

  /// Rounds the bounds to floats that hold them still, but for the cone, whose rounding the
  /// importance has room for.
  void describe(LightTree::Node& node, const Emission& b) const {
    node.center = vec3((dvec3(b.box.lower) + dvec3(b.box.upper)) / 2.0);
    const dvec3 reach =
        glm::max(dvec3(b.box.upper) - dvec3(node.center), dvec3(node.center) - dvec3(b.box.lower));
    node.radius = static_cast<float>(glm::length(reach) * (1 + 1e-6));
    node.axis = vec3(b.cone.axis);
    node.cosine = static_cast<float>(std::clamp(b.cone.cosine, -1.0, 1.0));
    node.energy = static_cast<float>(b.energy / tree_.energy);
  }

  void build_node(std::size_t node, std::size_t begin, std::size_t end, std::size_t level) {
    Emission bounds;
    for (std::size_t i = begin; i < end; ++i) bounds.add(emission_of(i));
    describe(tree_.nodes[node], bounds);
    if (is_leaf(begin, end, bounds.box)) {
      tree_.nodes[node].first = static_cast<std::uint32_t>(begin);
      tree_.nodes[node].count = static_cast<std::uint32_t>(end - begin);
      return;
    }
    const std::size_t middle = split(begin, end, bounds.box, level);
    const std::size_t child = tree_.nodes.size();
    tree_.nodes[node].first = static_cast<std::uint32_t>(child);
    tree_.nodes.resize(child + 2);
    tree_.nodes[child].parent = tree_.nodes[child + 1].parent = static_cast<std::uint32_t>(node);
    build_node(child, begin, middle, level + 1);
    build_node(child + 1, middle, end, level + 1);
  }

  /// Where a plane parts the centres of sources.
  struct Plane {
    double cost = std::numeric_limits<double>::infinity();
    int axis = 0;
    std::size_t bin = 0;  ///< the first beyond it
  };

  /// Moves the sources of the first child to the front; returns where the second's begin.
  std::size_t split(std::size_t begin, std::size_t end, const Box& box, std::size_t level) {
    const auto first = tree_.order.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = tree_.order.begin() + static_cast<std::ptrdiff_t>(end);
    if (level < level_of_halving) {
      const Plane plane = best_plane(begin, end, box);
      if (std::isfinite(plane.cost)) {
        const Span span = span_of(begin, end, plane.axis);
        const auto middle = std::stable_partition(first, last, [&](std::uint32_t i) {
          return span.bin(center_of(sources_[i], plane.axis)) < plane.bin;
        });
        return static_cast<std::size_t>(middle - tree_.order.begin());
      }
    }
    return begin + (end - begin) / 2;
  }

  /// The interval of the sources' centres along an axis, in bins.
  struct Span {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();

    [[nodiscard]] std::size_t bin(double x) const {
      const double share = (x - lower) / (upper - lower) * static_cast<double>(bin_count);
      return std::min(static_cast<std::size_t>(share), bin_count - 1);
    }
  };

  [[nodiscard]] Span span_of(std::size_t begin, std::size_t end, int axis) const {
    Span span;
    for (std::size_t i = begin; i < end; ++i) {
      span.lower = std::min(span.lower, center_of(source(i), axis));
      span.upper = std::max(span.upper, center_of(source(i), axis));
    }
    return span;
  }

  /// Infinite cost where no plane parts the centres.
  [[nodiscard]] Plane best_plane(std::size_t begin, std::size_t end, const Box& box) const {
    const dvec3 extent(box.extent());
    const double longest = std::max({extent.x, extent.y, extent.z});
    Plane best;
    for (int axis = 0; axis < 3; ++axis) {
      const Span span = span_of(begin, end, axis);
      if (!(span.lower < span.upper)) continue;
      std::array<Emission, bin_count> bins;
      for (std::size_t i = begin; i < end; ++i)
        bins.at(span.bin(center_of(source(i), axis))).add(emission_of(i));
      std::array<double, bin_count> above{};
      Emission swept;
      for (std::size_t b = bin_count; b-- > 1;) {
        swept.add(bins.at(b));
        above.at(b) = cost(swept);
      }
      swept = {};
      for (std::size_t b = 1; b < bin_count; ++b) {
        swept.add(bins.at(b - 1));
        // Thin slices of long nodes are dear: they stay long.
        const double c = (cost(swept) + above.at(b)) * longest / extent[axis];
        if (c < best.cost) best = {c, axis, b};
      }
    }
    return best;
  }

  std::span<const LightSource> sources_;
  std::map<std::uint32_t, Box> meshes_;  ///< of each mesh's sources
  LightTree tree_;
};

}  // namespace

LightSource piece_source(const Mesh& mesh, std::size_t first, std::size_t count) {
  LightSource s;
  std::vector<dvec3> normals;
  for (std::size_t i = first; i < first + count; ++i) {
    const auto [a, b, c] = triangle_corners(mesh, i);
    for (const vec3& corner : {a, b, c}) s.box.add(corner);
    normals.push_back(glm::normalize(glm::cross(dvec3(b) - dvec3(a), dvec3(c) - dvec3(a))));
    if (mesh.normal_indices.empty() || mesh.normal_indices[i].x == none) continue;
    const uvec3& n = mesh.normal_indices[i];
    normals.insert(normals.end(), {mesh.normals[n.x], mesh.normals[n.y], mesh.normals[n.z]});
  }
  dvec3 sum(0);
  for (const dvec3& n : normals) sum += n;
  if (!(glm::length(sum) > 0)) return s;
  const dvec3 axis = glm::normalize(sum);
  double cosine = 1;
  for (const dvec3& n : normals) cosine = std::min(cosine, glm::dot(axis, n));
  // Means of normals stay within a cone of less than a half space only.
  if (!(cosine > 0)) return s;
  s.axis = axis;
  s.cosine = cosine;
  return s;
}

LightTree build_light_tree(std::span<const LightSource> sources) {
  return LightTreeBuilder(sources).build();
}

}  // namespace facet
