// That the nearest hit is that of exact geometry up to rounding, whatever the triangles' shapes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "extremes/bsdf_inputs.h"
#include "extremes/ray_target.h"

namespace facet::extremes {

namespace {

/// What rounding 1 to float changes at most.
constexpr double rounding = 0x1p-24;

/// Any float from 0 to 1, now and then one of the ends.
double edge_heavy(Random& random) {
  const std::uint64_t kind = random.below(6);
  return kind == 0 ? 0 : kind == 1 ? 1 : random.number();
}

vec3 random_point(Random& random) {
  const auto number = [&] { return static_cast<float>(2 * random.number() - 1); };
  const float x = number();
  const float y = number();
  return {x, y, number()};
}

/// Triangles that go through each other: of any shape, needles, tiny ones, ones without area, and
/// one twice.
TriangleMesh soup(Random& random, float scale, const vec3& offset) {
  TriangleMesh mesh;
  const auto add = [&](const vec3& a, const vec3& b, const vec3& c) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const vec3& v : {a, b, c}) {
      const vec3 p = scale * (v + offset);
      mesh.positions.push_back({p.x, p.y, p.z});
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  };
  for (int i = 0; i < 48; ++i) {
    const vec3 a = random_point(random);
    vec3 b = random_point(random);
    vec3 c = random_point(random);
    switch (i % 8) {
      case 0:  // a needle
      case 1:
        c = glm::mix(a, b, static_cast<float>(random.number())) +
            static_cast<float>(std::pow(10.0, -1 - 6 * random.number())) * random_point(random);
        break;
      case 2:  // tiny
        b = a + 1e-4F * b;
        c = a + 1e-4F * c;
        break;
      case 3:  // two corners all but the same
        c = b + 1e-6F * c;
        break;
      case 4:  // in a plane of the axes
        b.y = a.y;
        c.y = a.y;
        break;
      case 5:  // without area, or nearly
        c = 0.5F * (a + b);
        break;
      default:
        break;
    }
    add(a, b, c);
    if (i % 8 == 6) add(a, b, c);
  }
  return mesh;
}

/// Towards or along something of a soup, from anywhere or from its corners and edges.
Ray ray_into(const TriangleMesh& mesh, float scale, const vec3& offset, Random& random) {
  const auto point = [&] {
    const auto& t = mesh.triangles[random.below(mesh.triangles.size())];
    const auto u = static_cast<float>(edge_heavy(random));
    const auto v = static_cast<float>(edge_heavy(random));
    const vec3 a = as_vec3(mesh.positions[t[0]]);
    const vec3 b = as_vec3(mesh.positions[t[1]]);
    return glm::mix(glm::mix(a, b, u), as_vec3(mesh.positions[t[2]]), v);
  };
  const vec3 from = random.below(4) == 0 ? point() : scale * (2.0F * random_point(random) + offset);
  Ray ray = ray_to(from, point());
  const std::uint64_t kind = random.below(8);
  if (kind == 0) {
    const auto axis = static_cast<int>(random.below(3));
    ray.direction = vec4(0, 0, 0, far_away);
    ray.direction[axis] = random.below(2) == 0 ? 1.0F : -1.0F;
  } else if (kind == 1) {
    ray.direction[static_cast<int>(random.below(3))] = 0;
  }
  return ray;
}

/// A triangle as a ray sees it, in double, lengths in roundings of its farthest coordinate.
struct Seen {
  double t = 0;        ///< of the plane, in lengths of the ray's direction
  double inside = -1;  ///< of the ray from the nearest edge, negative outside
  double slope = 0;    ///< how far from the plane the ray comes in a unit of t
};

/// Distance of the origin from the segment from a to b.
template <typename Vector>
double distance_to(const Vector& a, const Vector& b) {
  const Vector e = b - a;
  const double length2 = glm::dot(e, e);
  const double s = length2 > 0 ? std::clamp(-glm::dot(a, e) / length2, 0.0, 1.0) : 0;
  return glm::length(a + s * e);
}

/// Distance of a point from a triangle, of whatever shape.
double distance_from(const dvec3& p, const Corners& corners) {
  const dvec3 n = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  double distance = std::numeric_limits<double>::infinity();
  bool above = n != dvec3(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec3 a = corners.at(i) - p;
    const dvec3 b = corners.at((i + 1) % 3) - p;
    distance = std::min(distance, distance_to(a, b));
    above = above && glm::dot(n, glm::cross(a, b)) >= 0;
  }
  return above ? std::abs(glm::dot(glm::normalize(n), corners[0] - p)) : distance;
}

/// What rounding the largest coordinate of a triangle, seen from a ray's origin, changes at most.
double unit_of(const Ray& ray, const Corners& corners) {
  double size = 0;
  for (const dvec3& v : corners) {
    const dvec3 a = glm::abs(v - dvec3(ray.origin));
    size = std::max({size, a.x, a.y, a.z});
  }
  return rounding * size;
}

Seen seen(const Ray& ray, const Corners& corners) {
  const dvec3 o(ray.origin);
  const dvec3 d(ray.direction);
  const dvec3 n = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length = glm::length(d);
  if (length == 0 || n == dvec3(0)) return {};
  const double unit = unit_of(ray, corners);
  const double slope = glm::dot(glm::normalize(n), d);
  if (slope == 0) return {};
  Seen s;
  s.slope = std::abs(slope) / unit;
  s.t = glm::dot(glm::normalize(n), corners[0] - o) / slope;
  // The corners on a plane across the ray, which is its origin.
  const dvec3 w = d / length;
  const dvec3 x =
      glm::normalize(glm::cross(w, std::abs(w.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
  const dvec3 y = glm::cross(w, x);
  std::array<dvec2, 3> p{};
  for (std::size_t i = 0; i < 3; ++i)
    p.at(i) = {glm::dot(corners.at(i) - o, x), glm::dot(corners.at(i) - o, y)};
  double distance = std::numeric_limits<double>::infinity();
  int left = 0;
  int right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec2& a = p.at(i);
    const dvec2& b = p.at((i + 1) % 3);
    distance = std::min(distance, distance_to(a, b));
    const double turn = a.x * b.y - a.y * b.x;
    left += turn > 0 ? 1 : 0;
    right += turn < 0 ? 1 : 0;
  }
  s.inside = (left == 0 || right == 0 ? 1 : -1) * distance / unit;
  return s;
}

/// How a ray meets a triangle.
struct Meeting {
  double sine = 0;   ///< of the angle between them
  double width = 0;  ///< of the triangle, over its longest edge

  /// Whether floats tell the plane: neither a needle nor seen edge on.
  [[nodiscard]] bool is_plain() const { return sine >= 1e-3 && width >= 1e-4; }
};

Meeting meeting(const Ray& ray, const Corners& corners) {
  const dvec3 n = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    longest = std::max(longest, glm::length(corners.at((i + 1) % 3) - corners.at(i)));
  if (n == dvec3(0)) return {};
  return {std::abs(glm::dot(glm::normalize(n), glm::normalize(dvec3(ray.direction)))),
          glm::length(n) / (longest * longest)};
}

/// How many roundings a found hit is from its triangle, across it.
double misplacement(const RayTarget& target, const Ray& ray, const shared::HitRecord& hit,
                    bool plain) {
  if (hit.triangle == shared::NONE) return plain ? 0 : -1;
  const Corners own = target.corners(hit.triangle);
  const Meeting m = meeting(ray, own);
  if (m.is_plain() != plain) return -1;
  const dvec3 p = dvec3(ray.origin) + static_cast<double>(hit.t) * dvec3(ray.direction);
  return distance_from(p, own) / unit_of(ray, own) * (plain ? m.sine : 1);
}

/// By how many roundings a nearer triangle is inside its edges, before the hit, and after the
/// origin.
double overlooked(const TriangleMesh& mesh, const Ray& ray, const shared::HitRecord& hit) {
  const double t = hit.triangle == shared::NONE ? std::numeric_limits<double>::infinity()
                                                : static_cast<double>(hit.t);
  double worst = 0;
  for (const auto& i : mesh.triangles) {
    const Seen s =
        seen(ray, {dvec3(as_vec3(mesh.positions[i[0]])), dvec3(as_vec3(mesh.positions[i[1]])),
                   dvec3(as_vec3(mesh.positions[i[2]]))});
    worst = std::max(worst, std::min({s.inside, (t - s.t) * s.slope, s.t * s.slope}));
  }
  return worst;
}

/// deviation(target, mesh, ray, hit, whether any hit was found): of many rays through many soups.
template <typename Deviation>
Check soup_check(const char* name, const char* what, const Deviation& deviation) {
  Check check = ray_row(name, what, "2^-24 of the farthest coordinate", 9);
  check.measure = [deviation](Bench& bench) {
    const int soups = bench.quick() ? 6 : 200;
    const std::size_t rays_each = bench.quick() ? 20'000 : 60'000;
    Finding finding;
    for (int k = 0; k < soups; ++k) {
      Random random(static_cast<std::uint64_t>(k));
      const auto scale = static_cast<float>(std::pow(10.0, 6 - 3 * (k % 5)));
      const vec3 offset = k % 3 == 2 ? 100.0F * random_point(random) : vec3(0);
      const TriangleMesh mesh = soup(random, scale, offset);
      RayTarget target(bench, mesh);
      std::vector<Ray> rays;
      rays.reserve(rays_each);
      for (std::size_t i = 0; i < rays_each; ++i)
        rays.push_back(ray_into(mesh, scale, offset, random));
      const std::vector<shared::HitRecord> hits = target.closest(rays);
      const std::vector<bool> any = target.any(rays);
      std::vector<double> deviations(rays.size());
      parallel_for(rays.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          deviations[i] = any[i] == (hits[i].triangle != shared::NONE)
                              ? deviation(target, mesh, rays[i], hits[i])
                              : std::numeric_limits<double>::infinity();
      });
      for (std::size_t i = 0; i < rays.size(); ++i)
        finding.add(deviations[i],
                    [&] { return fmt::format("soup {}, {}", k, ray_text(rays[i])); });
      bench.tell(static_cast<double>(k) / soups);
    }
    return finding;
  };
  return check;
}

Check nearest_check() {
  return soup_check(
      "nearest hits",
      "soups of needles, slivers, tiny, huge, flat, doubled triangles and ones without area, sizes "
      "1e-6 to 1e6, up to 100 sizes from the origin; rays to and from vertices, edges and planes; "
      "against double: how far inside its edges is a nearer triangle",
      [](const RayTarget& /*target*/, const TriangleMesh& mesh, const Ray& ray,
         const shared::HitRecord& hit) { return overlooked(mesh, ray, hit); });
}

Check place_of_hit_check(bool plain) {
  Check check = soup_check(
      plain ? "places of hits" : "places of hits on needles, and edge on",
      plain ? "the same soups, triangles at least 1e-4 as wide as long, met at 1e-3 radians and "
              "more: distance from the triangle, across it"
            : "the same, all other triangles",
      [plain](const RayTarget& target, const TriangleMesh& /*mesh*/, const Ray& ray,
              const shared::HitRecord& hit) { return misplacement(target, ray, hit, plain); });
  if (!plain)
    check.argued =
        "Of a triangle narrower than 1e-4 of its length, or seen edge on, the corners in float do "
        "not tell the plane well enough: the distance along the ray is then uncertain by the size "
        "of the triangle and more. The hit's surface point is a mean of the corners, and right.";
  return check;
}

}  // namespace

std::vector<Check> hit_checks() {
  return {nearest_check(), place_of_hit_check(true), place_of_hit_check(false)};
}

}  // namespace facet::extremes
