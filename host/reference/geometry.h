#pragma once
// Triangles in the reference's precision, and what a ray meets among them.
#include <array>

#include "reference/probe.h"
#include "reference/real.h"
#include "reference/tree.h"
#include "scene/scene.h"

namespace facet::reference {

template <typename Real>
struct Ray {
  Vec3<Real> origin;
  Vec3<Real> direction;
  Real t_min = 0;
  Real t_max = unlimited<Real>;
};

/// triangle none: a miss. b1, b2: barycentric weights of the second and third vertex.
template <typename Real>
struct Hit {
  Real t = 0;
  std::uint32_t triangle = none;
  Real b1 = 0;
  Real b2 = 0;
};

/// A triangle as the intersector needs it, in the order of the tree's leaves.
template <typename Real>
struct Triangle {
  std::array<Vec3<Real>, 3> vertices;
  Vec3<Real> normal;  ///< unit, by the winding; formed in double
  /// By how much the normal moves when the vertices move by a relative 1: along the triangle's
  /// short side, for a triangle so flat that its two shorter edges are almost parallel.
  Vec3<Real> tilt;
  Real magnitude = 0;  ///< largest absolute coordinate of the vertices
  std::uint32_t mesh = 0;
  std::uint32_t index = 0;  ///< within the mesh
};

/// All triangles with an area.
template <typename Real>
struct Geometry {
  Tree tree;
  std::vector<Triangle<Real>> triangles;
  /// Place of a mesh's triangle i: places[first_place[mesh] + i]; none without area.
  std::vector<std::uint32_t> places;
  std::vector<std::size_t> first_place;
  Box bounds;  ///< of triangles with area

  explicit Geometry(const Scene& scene);
};

extern template struct Geometry<float>;
extern template struct Geometry<double>;

}  // namespace facet::reference
