#pragma once
// Rays through triangles on the device.
#include <limits>
#include <optional>

#include "extremes/scene_parts.h"
#include "render/ray_tracer.h"

namespace facet::extremes {

using Ray = shared::RayRecord;
using Corners = std::array<dvec3, 3>;

inline constexpr float far_away = std::numeric_limits<float>::infinity();

[[nodiscard]] std::string ray_text(const Ray& ray);

/// From a point in the direction of another, and on.
[[nodiscard]] Ray ray_to(const vec3& from, const vec3& to);

[[nodiscard]] inline vec3 as_vec3(const Vector3& v) { return {v[0], v[1], v[2]}; }

[[nodiscard]] Check ray_row(const char* name, const char* range, const char* unit, double limit);

class RayTarget {
 public:
  static constexpr std::uint32_t most_rays = 1U << 20U;

  RayTarget(Bench& bench, const TriangleMesh& mesh);

  /// What at most `most_rays` rays hit, and whether they hit anything; in their order. Throws
  /// DeviceError where a traversal was stopped.
  [[nodiscard]] std::vector<shared::HitRecord> closest(std::span<const Ray> rays);
  [[nodiscard]] std::vector<bool> any(std::span<const Ray> rays);

  /// Of the triangle that a hit names.
  [[nodiscard]] Corners corners(std::uint32_t triangle) const;

 private:
  void check_bound() const;

  PackedScene packed_;
  RayTracer tracer_;
};

}  // namespace facet::extremes
