#include "scene/scene.h"

namespace facet {

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

std::uint32_t Scene::environment() const {
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    if (std::holds_alternative<EnvironmentEmitter>(emitters[i])) return static_cast<std::uint32_t>(i);
  }
  return none;
}

}  // namespace facet
