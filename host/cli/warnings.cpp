#include "cli/warnings.h"

#include <algorithm>
#include <limits>

#include "core/print.h"

namespace facet::cli {

namespace {

/// Whether the whole scene lies before the near or beyond the far clip plane.
bool is_clipped_away(const Scene& scene) {
  const Box box = scene.bounds();
  if (box.empty()) return false;
  const dmat4 to_camera = glm::inverse(scene.camera.to_world);
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  for (int corner = 0; corner < 8; ++corner) {
    const dvec3 p((corner & 1) != 0 ? box.upper.x : box.lower.x,
                  (corner & 2) != 0 ? box.upper.y : box.lower.y,
                  (corner & 4) != 0 ? box.upper.z : box.lower.z);
    const double z = (to_camera * glm::dvec4(p, 1)).z;
    nearest = std::min(nearest, z);
    farthest = std::max(farthest, z);
  }
  return nearest > scene.camera.far_clip || (farthest > 0 && farthest < scene.camera.near_clip);
}

/// Whether no triangle of the mesh has an area that the renderer can hold.
bool is_without_area(const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.position_indices.size(); ++i) {
    if (triangle_area(mesh, i) > 0) return false;
  }
  return true;
}

}  // namespace

void warn_about_scene(const Scene& scene, Diagnostics& diagnostics) {
  const SourceLocation where{scene.file.string(), 0};
  if (scene.triangle_count() == 0) diagnostics.warn(where, "the scene has no triangles");
  if (scene.integrator.needs_emitters() && scene.emitters.empty()) {
    diagnostics.warn(where, fmt::format("the scene has no emitter, which {} needs: the image will be black",
                                        scene.integrator.type.name));
  }
  const bool point_lights = std::any_of(scene.emitters.begin(), scene.emitters.end(), [](const Emitter& e) {
    return std::holds_alternative<PointLight>(e);
  });
  if (point_lights && scene.integrator.type.material_sampling && !scene.integrator.type.emitter_sampling) {
    diagnostics.warn(
        where, fmt::format("{} samples only BSDFs, which never find a point light: its light is missing",
                           scene.integrator.type.name));
  }
  for (const Emitter& emitter : scene.emitters) {
    const auto* area = std::get_if<AreaEmitter>(&emitter);
    if (area != nullptr && is_without_area(scene.meshes[area->mesh])) {
      diagnostics.warn(
          scene.meshes[area->mesh].where,
          fmt::format("the emitting mesh {} has no area: it gives no light", scene.meshes[area->mesh].name));
    }
  }
  if (is_clipped_away(scene)) {
    diagnostics.warn(
        where,
        fmt::format("the whole scene lies outside the camera's clip planes (nearClip {:g}, farClip {:g})",
                    scene.camera.near_clip, scene.camera.far_clip));
  }
}

void print_warnings(const Diagnostics& diagnostics) {
  for (const std::string& warning : diagnostics.warnings()) say("warning: {}\n", warning);
}

}  // namespace facet::cli
