#include "reference/geometry.h"

#include <algorithm>
#include <array>

namespace facet::reference {

namespace {

/// Unit normal of a triangle; sizes that would under- or overflow in the products are taken out
/// first.
dvec3 winding_normal(const dvec3& a, const dvec3& b, const dvec3& c) {
  return unit(glm::cross(unit(b - a), unit(c - a)));
}

/// Triangle::tilt. n: the normal.
dvec3 tilt_of(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& n) {
  std::array<dvec3, 3> edges{b - a, c - b, a - c};
  std::ranges::sort(edges, {}, [](const dvec3& e) { return glm::length(e); });
  const double sine = glm::length(glm::cross(unit(edges[0]), unit(edges[1])));
  // Those of other triangles have all their digits, and zeros that are exact.
  return sine > 0.1 ? dvec3(0) : unit(glm::cross(n, edges[2])) / sine;
}

}  // namespace

template <typename Real>
Geometry<Real>::Geometry(const Scene& scene) {
  std::vector<Triangle<Real>> unordered;
  std::vector<Box> boxes;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    first_place.push_back(places.size());
    for (std::uint32_t i = 0; i < mesh.position_indices.size(); ++i) {
      places.push_back(none);
      if (!(triangle_area(mesh, i) > 0)) continue;
      Triangle<Real> t;
      Box box;
      for (int k = 0; k < 3; ++k) {
        const vec3& p = mesh.positions[mesh.position_indices[i][k]];
        t.vertices[static_cast<std::size_t>(k)] = p;
        box.add(p);
        t.magnitude = std::max(t.magnitude, largest_component(Vec3<Real>(p)));
      }
      const std::array corners{dvec3(t.vertices[0]), dvec3(t.vertices[1]), dvec3(t.vertices[2])};
      const dvec3 normal = winding_normal(corners[0], corners[1], corners[2]);
      t.normal = normal;
      t.tilt = tilt_of(corners[0], corners[1], corners[2], normal);
      t.mesh = m;
      t.index = i;
      bounds.add(box);
      boxes.push_back(box);
      unordered.push_back(t);
    }
  }
  tree = build_tree(boxes);
  triangles.reserve(unordered.size());
  for (const std::uint32_t i : tree.order) {
    const Triangle<Real>& t = unordered[i];
    places[first_place[t.mesh] + t.index] = static_cast<std::uint32_t>(triangles.size());
    triangles.push_back(t);
  }
}

template struct Geometry<float>;
template struct Geometry<double>;

}  // namespace facet::reference
