#pragma once
// What a point of a triangle looks like.
#include "reference/geometry.h"

namespace facet::reference {

template <typename Real>
struct Surface {
  Vec3<Real> position;
  Vec3<Real> ng;       ///< geometric normal, unit, by the winding
  Vec3<Real> ns;       ///< shading normal, unit
  Vec2<Real> uv{0};    ///< where the scene has textures
  Real magnitude = 0;  ///< largest absolute coordinate of the triangle's vertices
  std::uint32_t mesh = 0;
  std::uint32_t index = 0;  ///< of the triangle within the mesh

  /// Where a ray that leaves in direction d starts (docs/reference/sampling.md, "Ray offset").
  /// which: number of the decision.
  template <typename Probe>
  [[nodiscard]] Vec3<Real> origin_towards(const Vec3<Real>& d, std::uint64_t which,
                                          Probe& probe) const {
    const Real cosine = glm::dot(d, ng);
    const bool below = probe.negative(DecisionKind::offset, cosine, which);
    const Real distance = magnitude / 1048576;  // 16 * 2^-24
    return below ? position - ng * distance : position + ng * distance;
  }

  /// The shading frame.
  template <typename Probe>
  [[nodiscard]] Frame<Real> frame(Probe& probe) const {
    return {ns, probe.negative(DecisionKind::frame, ns.z)};
  }
};

/// Texture coordinates of a point of a triangle of the mesh.
template <typename Real, typename Probe>
[[nodiscard]] Vec2<Real> texture_coordinates(const Mesh& mesh, std::uint32_t triangle,
                                             const Vec3<Real>& b, Probe& probe) {
  if (mesh.texcoord_indices.empty() || mesh.texcoord_indices[triangle].x == none) return {b.y, b.z};
  const uvec3& i = mesh.texcoord_indices[triangle];
  const Vec2<Real> uv = b.x * Vec2<Real>(mesh.texcoords[i.x]) +
                        b.y * Vec2<Real>(mesh.texcoords[i.y]) +
                        b.z * Vec2<Real>(mesh.texcoords[i.z]);
  return Vec2<Real>(probe.nudged(Vec3<Real>(uv, 0)));
}

template <typename Real, typename Probe>
[[nodiscard]] Surface<Real> surface_at(const Scene& scene, const Triangle<Real>& triangle, Real b1,
                                       Real b2, Probe& probe) {
  const Real b0 = 1 - b1 - b2;
  Surface<Real> s;
  s.position = probe.nudged(b0 * triangle.vertices[0] + b1 * triangle.vertices[1] +
                            b2 * triangle.vertices[2]);
  s.ng = triangle.normal;
  if (triangle.tilt != Vec3<Real>(0)) s.ng += triangle.tilt * (probe.nudged(Real(1)) - 1);
  s.ng = s.ns = probe.nudged(s.ng);
  s.magnitude = triangle.magnitude;
  s.mesh = triangle.mesh;
  s.index = triangle.index;
  const Mesh& mesh = scene.meshes[triangle.mesh];
  if (!scene.textures.empty())
    s.uv = texture_coordinates(mesh, triangle.index, Vec3<Real>(b0, b1, b2), probe);
  if (mesh.normal_indices.empty() || mesh.normal_indices[triangle.index].x == none) return s;
  probe.uses(Part::vertex_normals, 0);
  const uvec3& n = mesh.normal_indices[triangle.index];
  const Vec3<Real> sum = b0 * Vec3<Real>(mesh.normals[n.x]) + b1 * Vec3<Real>(mesh.normals[n.y]) +
                         b2 * Vec3<Real>(mesh.normals[n.z]);
  if (largest_component(sum) > 0) s.ns = probe.nudged(unit(sum));
  return s;
}

}  // namespace facet::reference
