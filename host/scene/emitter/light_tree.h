#pragma once
// The tree over all that emits from a place, by which an emitter sample finds what can light a
// point (docs/reference/sampling.md, "Light tree").
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace facet {

/// Something that emits: a piece of an emitting mesh, or a point light.
struct LightSource {
  Box box;              ///< of all its points
  dvec3 axis{0, 0, 1};  ///< with `cosine`: a cone that holds its normals, geometric and of shading
  double cosine = -1;   ///< of the cone's half angle; -1: every direction
  double energy = 0;    ///< luminance times area, W sr^-1: of a point light, its intensity; above 0
  std::uint32_t mesh = none;  ///< sources of one mesh may share a leaf; none: a leaf of its own
};

/// The bounds of a piece of a mesh, its triangles [first, first + count); mesh and energy are the
/// caller's.
[[nodiscard]] LightSource piece_source(const Mesh& mesh, std::size_t first, std::size_t count);

struct LightTree {
  /// A node: what is known of the sources below it.
  struct Node {
    vec3 center{0};  ///< of a sphere that holds their boxes
    float radius = 0;
    vec3 axis{0, 0, 1};  ///< of a cone that holds their normals
    float cosine = -1;
    float energy = 0;             ///< their sum, as a share of the whole tree's
    std::uint32_t parent = none;  ///< none: the root
    std::uint32_t first = 0;  ///< of a leaf's range of `order`; else the first child, beside which
                              ///< the second lies
    std::uint32_t count = 0;  ///< of a leaf's sources; 0: an inner node

    [[nodiscard]] bool is_leaf() const { return count > 0; }
  };

  std::vector<Node> nodes;           ///< the root first; empty without sources
  std::vector<std::uint32_t> order;  ///< the sources, leaf by leaf
  double energy = 0;                 ///< of all sources, W sr^-1
};

/// Splits by the surface area orientation heuristic (A. Conty Estevez, C. Kulla, "Importance
/// Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018). A leaf is one source, or up to
/// 64 neighbours of one mesh where they are small beside it; it lies at most
/// shared::LIGHT_TREE_DEPTH levels below the root. Deterministic.
[[nodiscard]] LightTree build_light_tree(std::span<const LightSource> sources);

}  // namespace facet
