#include "door/warnings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>

#include "accel/coinciding_triangles.h"
#include "core/parallel.h"

namespace facet {

namespace {

/// Whether the whole box lies before the near or beyond the far clip plane.
bool is_clipped_away(const Camera& camera, const Box& box) {
  if (box.empty()) return false;
  const dmat4 to_camera = glm::inverse(camera.to_world);
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
  return nearest > camera.far_clip || (farthest > 0 && farthest < camera.near_clip);
}

/// Whether no triangle of the mesh has an area that the renderer can hold.
bool is_without_area(const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.position_indices.size(); ++i) {
    if (triangle_area(mesh, i) > 0) return false;
  }
  return true;
}

/// A triangle of a scene.
struct TrianglePlace {
  std::uint32_t mesh;
  std::size_t triangle;

  [[nodiscard]] bool operator==(const TrianglePlace&) const = default;
};

TriangleCorners corners_of(const Scene& scene, const TrianglePlace& place) {
  return triangle_corners(scene.meshes[place.mesh], place.triangle);
}

dvec3 area_normal(const TriangleCorners& t) {
  return glm::cross(dvec3(t[1]) - dvec3(t[0]), dvec3(t[2]) - dvec3(t[0]));
}

/// Whether the two are seen in one another's place: not where they lie back to back, as the bottom
/// of a lamp and the table that it stands on, unless the camera is on the emitter's bright side.
bool compete(const TriangleCorners& emitting, const TriangleCorners& other, const dvec3& camera) {
  const dvec3 normal = area_normal(emitting);
  return glm::dot(normal, area_normal(other)) > 0 ||
         glm::dot(normal, camera - dvec3(emitting[0])) > 0;
}

/// Pairs of an emitting mesh and one that it coincides with, which may be itself. Of two that emit,
/// which meet twice, the first in the scene comes first.
std::set<std::pair<std::uint32_t, std::uint32_t>> find_coinciding_emitters(const Scene& scene) {
  std::vector<TrianglePlace> places;
  std::vector<TriangleCorners> emitting;
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    if (scene.meshes[mesh].emitter == none) continue;
    for (std::size_t i = 0; i < scene.meshes[mesh].position_indices.size(); ++i) {
      places.push_back({mesh, i});
      emitting.push_back(corners_of(scene, places.back()));
    }
  }
  const CoincidenceFinder finder(std::move(emitting));
  // A second or two, however many boxes overlap.
  constexpr std::size_t most_tests = 20'000'000;
  const std::size_t most_looked_at =
      std::max<std::size_t>(64, most_tests / std::max<std::size_t>(1, scene.triangle_count()));
  const dvec3 camera(scene.camera.to_world[3]);
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::mutex mutex;
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    const auto look_at = [&](const TrianglePlace& other) {
      const TriangleCorners corners = corners_of(scene, other);
      finder.find(corners, most_looked_at, [&](std::size_t k) {
        if (places[k] == other || !compete(corners_of(scene, places[k]), corners, camera)) return;
        const bool both_emit = scene.meshes[mesh].emitter != none;
        const std::scoped_lock lock(mutex);
        if (both_emit && mesh < places[k].mesh) {
          pairs.insert({mesh, places[k].mesh});
        } else {
          pairs.insert({places[k].mesh, mesh});
        }
      });
    };
    parallel_for(scene.meshes[mesh].position_indices.size(), 1U << 14U,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = begin; i < end; ++i) look_at({mesh, i});
                 });
  }
  return pairs;
}

void warn_about_coinciding_emitters(const Scene& scene, Diagnostics& diagnostics) {
  for (const auto& [emitting, other] : find_coinciding_emitters(scene)) {
    diagnostics.warn(
        scene.meshes[emitting].where,
        fmt::format("the emitting mesh {} and {} lie in one plane and overlap: rounding decides "
                    "which of the "
                    "two a ray meets, and estimators differ in it; move one of them a little",
                    scene.meshes[emitting].name,
                    emitting == other ? "itself" : scene.meshes[other].name));
  }
}

/// Squares of lengths have to be within a float's range, those of a scene's details as well.
void warn_about_size(const SourceLocation& where, const Box& box, Diagnostics& diagnostics) {
  if (box.empty()) return;
  const dvec3 farthest = glm::max(glm::abs(dvec3(box.lower)), glm::abs(dvec3(box.upper)));
  const double size = std::max({farthest.x, farthest.y, farthest.z});
  constexpr double smallest = 1e-15;
  constexpr double largest = 1e18;
  if (size == 0 || (size >= smallest && size <= largest)) return;
  diagnostics.warn(where,
                   fmt::format("the largest coordinate is {:.2g}: single precision computes with "
                               "scenes of {:g} to {:g}, this image will be wrong; the reference in "
                               "double does not mind",
                               size, smallest, largest));
}

/// Directions are unit vectors of floats: that of a ray errs by about 2^-24, whatever the field of
/// view.
void warn_about_narrow_pixels(const Scene& scene, const RenderSettings& settings,
                              Diagnostics& diagnostics) {
  constexpr double rounding = 0x1p-24;
  const Camera camera = camera_of(scene, settings);
  const dvec3 forwards = glm::normalize(dvec3(camera.to_world[2]));
  const dvec3 size = glm::abs(forwards);
  // Along an axis, what differs between rays are small numbers, which floats hold as exactly as
  // large ones.
  if (std::max({size.x, size.y, size.z}) > 1 - 1e-12) return;
  const double pixel = 2 * std::tan(glm::radians(camera.fov) / 2) / camera.width;
  if (pixel > 32 * rounding) return;
  diagnostics.warn(
      {scene.file.string(), 0},
      fmt::format("a pixel is {:.2g} degrees wide (fov {:g}), and directions in single precision "
                  "are rounded to {:.2g}: edges lie up to {:.1g} pixels beside their places; the "
                  "reference in double does not mind",
                  glm::degrees(pixel), camera.fov, glm::degrees(rounding), rounding / pixel));
}

}  // namespace

void warn_about_render(const Scene& scene, const RenderSettings& settings, Diagnostics& diagnostics,
                       bool in_double) {
  const Integrator& integrator = settings.integrator;
  const SourceLocation where{scene.file.string(), 0};
  const Box bounds = scene.bounds();
  if (scene.triangle_count() == 0) diagnostics.warn(where, "the scene has no triangles");
  if (integrator.needs_emitters() && scene.emitters.empty()) {
    diagnostics.warn(
        where, fmt::format("the scene has no emitter, which {} needs: the image will be black",
                           integrator.type.name));
  }
  const bool point_lights =
      std::any_of(scene.emitters.begin(), scene.emitters.end(),
                  [](const Emitter& e) { return std::holds_alternative<PointLight>(e); });
  if (point_lights && integrator.type.material_sampling && !integrator.type.emitter_sampling) {
    diagnostics.warn(
        where,
        fmt::format("{} samples only BSDFs, which never find a point light: its light is missing",
                    integrator.type.name));
  }
  for (const Emitter& emitter : scene.emitters) {
    const auto* area = std::get_if<AreaEmitter>(&emitter);
    if (area != nullptr && is_without_area(scene.meshes[area->mesh])) {
      diagnostics.warn(scene.meshes[area->mesh].where,
                       fmt::format("the emitting mesh {} has no area: it gives no light",
                                   scene.meshes[area->mesh].name));
    }
  }
  warn_about_coinciding_emitters(scene, diagnostics);
  if (!in_double) {
    warn_about_size(where, bounds, diagnostics);
    warn_about_narrow_pixels(scene, settings, diagnostics);
  }
  if (is_clipped_away(scene.camera, bounds)) {
    diagnostics.warn(
        where,
        fmt::format(
            "the whole scene lies outside the camera's clip planes (nearClip {:g}, farClip {:g})",
            scene.camera.near_clip, scene.camera.far_clip));
  }
}

}  // namespace facet
