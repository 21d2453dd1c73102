#pragma once
// Scenes made in memory.
#include "scene/scene.h"

namespace facet::test {

/// A mesh without normals of the given triangles, three positions each.
[[nodiscard]] Mesh make_mesh(const std::vector<vec3>& corners);

/// Two triangles, counter-clockwise seen from the side of their normal.
[[nodiscard]] Mesh make_quad(const vec3& a, const vec3& b, const vec3& c, const vec3& d);

/// The box [-1, 1]^3, normals inwards, each face divided into n x n quads; faces share their
/// border's vertices exactly.
[[nodiscard]] Mesh make_room(int n);

/// Unit sphere by subdividing an octahedron, normals outwards (or inwards), no vertex normals.
[[nodiscard]] Mesh make_sphere(int subdivisions, bool inwards);

/// Adds a mesh with its BSDF and, unless the radiance is black, as an area emitter.
void add_mesh(Scene& scene, Mesh mesh, const Bsdf& bsdf, const Color& radiance = Color(0));

/// Moves every vertex to scale * p + offset.
void transform(Mesh& mesh, float scale, const vec3& offset);

/// A camera of a square image, looking from `origin` to `target`, box filter, unlimited clip
/// planes.
void set_camera(Scene& scene, int size, double fov, const dvec3& origin, const dvec3& target,
                const dvec3& up = {0, 1, 0});

/// An empty scene whose integrator is named.
[[nodiscard]] Scene make_scene(const std::string& integrator);

}  // namespace facet::test
