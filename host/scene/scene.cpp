#include "scene/scene.h"

#include <limits>

namespace facet {

std::array<vec3, 3> triangle_corners(const Mesh& mesh, std::size_t triangle) {
  const uvec3& i = mesh.position_indices[triangle];
  return {mesh.positions[i.x], mesh.positions[i.y], mesh.positions[i.z]};
}

double triangle_area(const Mesh& mesh, std::size_t triangle) {
  const auto [a, b, c] = triangle_corners(mesh, triangle);
  const dvec3 e1 = dvec3(b) - dvec3(a);
  const dvec3 e2 = dvec3(c) - dvec3(a);
  const double area = 0.5 * glm::length(glm::cross(e1, e2));
  return area >= std::numeric_limits<float>::min() ? area : 0;
}

std::size_t Scene::triangle_count() const {
  std::size_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.position_indices.size();
  return count;
}

Box Scene::bounds() const {
  Box box;
  for (const Mesh& mesh : meshes) {
    for (const vec3& p : mesh.positions) box.add(p);
  }
  return box;
}

Color Scene::mean_radiance(const AreaEmitter& emitter) const {
  const Textured<Color> emitted = emitter.emitted();
  return emitted.is_textured() ? emitted.value * mean(textures[emitted.texture]) : emitted.value;
}

std::uint32_t Scene::environment() const {
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    if (std::holds_alternative<EnvironmentEmitter>(emitters[i]))
      return static_cast<std::uint32_t>(i);
  }
  return none;
}

}  // namespace facet
