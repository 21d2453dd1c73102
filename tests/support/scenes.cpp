#include "support/scenes.h"

#include <array>

namespace facet::test {

Mesh make_mesh(const std::vector<vec3>& corners) {
  Mesh mesh;
  mesh.name = "made in memory";
  mesh.positions = corners;
  for (std::uint32_t i = 0; i + 2 < corners.size(); i += 3)
    mesh.position_indices.emplace_back(i, i + 1, i + 2);
  return mesh;
}

Mesh make_quad(const vec3& a, const vec3& b, const vec3& c, const vec3& d) {
  return make_mesh({a, b, c, a, c, d});
}

Mesh make_room(int n) {
  std::vector<vec3> corners;
  const auto coordinate = [n](int i) {
    return i == n ? 1.0F : -1.0F + 2.0F * static_cast<float>(i) / static_cast<float>(n);
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      const auto point = [&](int i, int j) {
        vec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = coordinate(i);
        p[(axis + 2) % 3] = coordinate(j);
        return p;
      };
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          std::array<vec3, 4> q{point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)};
          if (side > 0) std::swap(q[1], q[3]);
          corners.insert(corners.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
        }
      }
    }
  }
  return make_mesh(corners);
}

namespace {

void subdivide(std::vector<vec3>& out, const vec3& a, const vec3& b, const vec3& c, int levels) {
  if (levels == 0) {
    out.insert(out.end(), {a, b, c});
    return;
  }
  // a + b is the same number as b + a, so triangles on both sides of an edge get the same midpoint.
  const vec3 ab = glm::normalize(a + b);
  const vec3 bc = glm::normalize(b + c);
  const vec3 ca = glm::normalize(c + a);
  subdivide(out, a, ab, ca, levels - 1);
  subdivide(out, ab, b, bc, levels - 1);
  subdivide(out, ca, bc, c, levels - 1);
  subdivide(out, ab, bc, ca, levels - 1);
}

}  // namespace

Mesh make_sphere(int subdivisions, bool inwards) {
  const std::array<vec3, 6> p{vec3(1, 0, 0),  vec3(-1, 0, 0), vec3(0, 1, 0),
                              vec3(0, -1, 0), vec3(0, 0, 1),  vec3(0, 0, -1)};
  constexpr std::array<std::array<std::size_t, 3>, 8> faces{
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  std::vector<vec3> corners;
  for (const auto& f : faces)
    subdivide(corners, p[f[0]], p[inwards ? f[2] : f[1]], p[inwards ? f[1] : f[2]], subdivisions);
  return make_mesh(corners);
}

void add_mesh(Scene& scene, Mesh mesh, const Bsdf& bsdf, const Color& radiance) {
  mesh.bsdf = static_cast<std::uint32_t>(scene.bsdfs.size());
  scene.bsdfs.push_back(bsdf);
  if (radiance != Color(0)) {
    mesh.emitter = static_cast<std::uint32_t>(scene.emitters.size());
    scene.emitters.emplace_back(
        AreaEmitter{static_cast<std::uint32_t>(scene.meshes.size()), radiance});
  }
  scene.meshes.push_back(std::move(mesh));
}

void transform(Mesh& mesh, float scale, const vec3& offset) {
  for (vec3& p : mesh.positions) p = scale * p + offset;
}

void set_camera(Scene& scene, int size, double fov, const dvec3& origin, const dvec3& target,
                const dvec3& up) {
  const dvec3 forward = glm::normalize(target - origin);
  const dvec3 right = glm::normalize(glm::cross(forward, up));
  Camera& c = scene.camera;
  c.width = size;
  c.height = size;
  c.fov = fov;
  c.near_clip = 0;
  c.far_clip = 1e30;
  c.filter = BoxFilter{};
  // +x of the camera is on the image's left.
  c.to_world = dmat4(glm::dvec4(-right, 0), glm::dvec4(glm::cross(right, forward), 0),
                     glm::dvec4(forward, 0), glm::dvec4(origin, 1));
}

Scene make_scene(const std::string& integrator) {
  Scene scene;
  scene.integrator.type = find_integrator_type(integrator).value();
  return scene;
}

}  // namespace facet::test
