#include "support/brute_force.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "render/ray_tracer.h"
#include "support/render.h"

namespace facet::test {
namespace {

struct Candidate {
  double t = 1e300;
  double margin = 0;  ///< smallest barycentric weight: near 0 at an edge
  double b1 = 0;      ///< weight of the second vertex
  double b2 = 0;      ///< of the third
  std::uint32_t id = none;
};

/// Moeller and Trumbore 1997, in double.
Candidate intersect(const shared::RayRecord& ray, const std::array<dvec3, 3>& v, std::uint32_t id) {
  const dvec3 o(ray.origin);
  const dvec3 d(ray.direction);
  const dvec3 e1 = v[1] - v[0];
  const dvec3 e2 = v[2] - v[0];
  const dvec3 p = glm::cross(d, e2);
  const double det = glm::dot(e1, p);
  if (det == 0) return {};
  const double b1 = glm::dot(o - v[0], p) / det;
  const dvec3 q = glm::cross(o - v[0], e1);
  const double b2 = glm::dot(d, q) / det;
  return {glm::dot(e2, q) / det, std::min({b1, b2, 1 - b1 - b2}), b1, b2, id};
}

std::vector<std::array<dvec3, 3>> all_triangles(const Scene& scene) {
  std::vector<std::array<dvec3, 3>> triangles;
  for (const Mesh& m : scene.meshes) {
    for (const uvec3& i : m.position_indices)
      triangles.push_back({m.positions[i.x], m.positions[i.y], m.positions[i.z]});
  }
  return triangles;
}

/// A kernel's hit is right if its triangle is hit there in exact arithmetic up to rounding, and
/// nothing clearly inside a triangle is clearly nearer.
std::string check_hit(const shared::RayRecord& ray, const shared::HitRecord& hit, std::uint32_t id,
                      const std::vector<std::array<dvec3, 3>>& triangles, double slack) {
  Candidate nearest;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Candidate c = intersect(ray, triangles[i], i);
    if (c.id != none && c.margin > slack && c.t > ray.origin.w && c.t < ray.direction.w &&
        c.t < nearest.t)
      nearest = c;
  }
  if (hit.triangle == none)
    return nearest.id == none ? "" : fmt::format("missed triangle {} at {}", nearest.id, nearest.t);
  const Candidate own = intersect(ray, triangles[id], id);
  const double tolerance = slack * std::abs(own.t);
  if (own.margin < -slack) return fmt::format("hit triangle {} outside by {}", id, own.margin);
  if (std::abs(own.t - static_cast<double>(hit.t)) > tolerance)
    return fmt::format("t {} instead of {}", hit.t, own.t);
  if (std::abs(own.b1 - static_cast<double>(hit.b1)) > 10 * slack ||
      std::abs(own.b2 - static_cast<double>(hit.b2)) > 10 * slack)
    return fmt::format("weights {}, {} instead of {}, {}", hit.b1, hit.b2, own.b1, own.b2);
  if (nearest.t < own.t - tolerance)
    return fmt::format("triangle {} at {} is nearer than {} at {}", nearest.id, nearest.t, id,
                       own.t);
  return "";
}

}  // namespace

Comparison compare_with_brute_force(const Scene& scene, double slack, bool storage_buffers) {
  RenderSettings settings = whole_image(scene, 1);
  settings.force_storage_buffers = storage_buffers;
  const PackedScene packed = pack_scene(scene, settings);
  Renderer renderer(device(), packed);
  const std::vector<shared::RayRecord> rays = renderer.camera_rays();
  RayTracer tracer(device(), packed, static_cast<std::uint32_t>(rays.size()), storage_buffers);
  tracer.set_rays(rays);
  tracer.trace_closest();
  const std::vector<shared::HitRecord> hits = tracer.hits();
  EXPECT_EQ(tracer.bound_hits(), 0U);
  expect_silent_validation();
  const auto triangles = all_triangles(scene);
  std::vector<std::string> complaints(rays.size());
  parallel_for(rays.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t id =
          hits[i].triangle == none ? none : packed.scene_index(hits[i].triangle);
      complaints[i] = check_hit(rays[i], hits[i], id, triangles, slack);
    }
  });
  Comparison result;
  result.rays = rays.size();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    result.hits += hits[i].triangle != none ? 1 : 0;
    if (complaints[i].empty()) continue;
    ++result.unexplained;
    if (result.first.empty()) result.first = fmt::format("ray {}: {}", i, complaints[i]);
  }
  return result;
}

void expect_right_hits(const Scene& scene, double slack, std::size_t least_hits) {
  for (const bool storage_buffers : {false, true}) {
    const Comparison c = compare_with_brute_force(scene, slack, storage_buffers);
    EXPECT_EQ(c.unexplained, 0U) << c.first;
    EXPECT_GE(c.hits, least_hits) << "of " << c.rays;
  }
}

}  // namespace facet::test
