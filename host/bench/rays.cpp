#include "bench/rays.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "shared/random_hash.h"

namespace facet::bench {

namespace {

using shared::RayRecord;

constexpr float farthest = std::numeric_limits<float>::max();

/// Three numbers in [0, 1) of a ray.
vec3 random_numbers(std::size_t ray, std::uint32_t purpose) {
  const glm::uvec4 words = shared::pcg4d({static_cast<std::uint32_t>(ray), purpose, 0U, 0U});
  return vec3(glm::uvec3(words) >> 8U) * 0x1p-24F;
}

/// A direction of density cos/pi about the unit vector n.
vec3 cosine_direction(const vec3& n, float u, float v) {
  const float z = 1 - 2 * u;
  const float r = std::sqrt(std::max(0.0F, 1 - z * z));
  const float phi = 2 * std::numbers::pi_v<float> * v;
  // A point of the unit sphere that touches the surface; at its foot there is no direction.
  const vec3 sum = n + vec3(r * std::cos(phi), r * std::sin(phi), z);
  const float length = glm::length(sum);
  return length > 1e-4F ? sum / length : n;
}

/// Where a camera ray ended: just above the surface on the ray's side.
struct Place {
  vec3 position;
  vec3 normal;  ///< unit
};

class RayMaker {
 public:
  explicit RayMaker(const PackedScene& packed) : packed_(packed) {}

  [[nodiscard]] Place place_of(const RayRecord& ray, const shared::HitRecord& hit) const {
    const auto [a, b, c] = packed_.triangle(hit.triangle);
    vec3 n = glm::normalize(glm::cross(b - a, c - a));
    if (glm::dot(n, vec3(ray.direction)) > 0) n = -n;
    const vec3 p = (1 - hit.b1 - hit.b2) * a + hit.b1 * b + hit.b2 * c;
    const vec3 size = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
    return {p + n * (1e-5F * std::max(size.x, std::max(size.y, size.z))), n};
  }

  static RayRecord bounce(const Place& at, std::size_t ray) {
    const vec3 u = random_numbers(ray, 1);
    return {glm::vec4(at.position, 0), glm::vec4(cosine_direction(at.normal, u.x, u.y), farthest)};
  }

  /// Nothing where the light lies behind the surface, or shows its back.
  [[nodiscard]] std::optional<RayRecord> to_light(const Place& at, std::size_t ray) const {
    const vec3 u = random_numbers(ray, 2);
    if (packed_.emitter_triangles.empty()) return bounce(at, ray + (std::size_t{1} << 31U));
    const auto count = packed_.emitter_triangles.size();
    const auto chosen =
        std::min(count - 1, static_cast<std::size_t>(u.z * static_cast<float>(count)));
    const shared::EmitterTriangle& triangle = packed_.emitter_triangles[chosen];
    if (!(triangle.density > 0)) return std::nullopt;
    const auto [a, b, c] = packed_.triangle(triangle.triangle);
    const float root = std::sqrt(u.x);
    const vec3 d = (1 - root) * a + root * (1 - u.y) * b + root * u.y * c - at.position;
    if (glm::dot(d, at.normal) <= 0 || glm::dot(d, glm::cross(b - a, c - a)) >= 0)
      return std::nullopt;
    // Ends just before the light.
    return RayRecord{glm::vec4(at.position, 0), glm::vec4(d, 0.9999F)};
  }

 private:
  const PackedScene& packed_;
};

}  // namespace

std::vector<RaySet> make_ray_sets(const PackedScene& packed, std::span<const RayRecord> camera_rays,
                                  std::span<const shared::HitRecord> camera_hits) {
  RaySet camera{"camera", false, {camera_rays.begin(), camera_rays.end()}};
  RaySet diffuse{"diffuse", false, {}};
  RaySet shadow{"shadow", true, {}};
  const RayMaker maker(packed);
  for (std::size_t i = 0; i < camera_rays.size(); ++i) {
    if (camera_hits[i].triangle == shared::NONE) continue;
    const Place at = maker.place_of(camera_rays[i], camera_hits[i]);
    diffuse.rays.push_back(RayMaker::bounce(at, i));
    if (const auto ray = maker.to_light(at, i)) shadow.rays.push_back(*ray);
  }
  return {std::move(camera), std::move(diffuse), std::move(shadow)};
}

}  // namespace facet::bench
