// That no ray leaks between neighbouring triangles, and that hits along axes are exact.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "extremes/bsdf_inputs.h"
#include "extremes/ray_target.h"

namespace facet::extremes {

namespace {

struct Body {
  const char* name;
  TriangleMesh mesh;
  Vector3 scale;  ///< of a ball of radius 0.5 to 1 about the origin
  Vector3 offset;
};

TriangleMesh rough_ball() {
  return ball(4, [](const Vector3& d) {
    return 0.75F + 0.25F * std::sin(40 * d[0] + 70 * d[1] - 50 * d[2]);
  });
}

/// Closed meshes that are seen whole from near their middle.
std::vector<Body> closed_bodies() {
  const TriangleMesh even = ball(5, [](const Vector3&) { return 1.0F; });
  const TriangleMesh rough = rough_ball();
  const TriangleMesh eight = ball(0, [](const Vector3&) { return 1.0F; });
  std::vector<Body> bodies = {
      {"ball", even, {1, 1, 1}, {0, 0, 0}},
      {"rough ball", rough, {1, 1, 1}, {0, 0, 0}},
      {"octahedron", eight, {1, 1, 1}, {0, 0, 0}},
      {"rough ball, 1000 sizes from the origin", rough, {1, 1, 1}, {1000, 700, -400}},
      {"rough ball of 1e-6", rough, {1e-6F, 1e-6F, 1e-6F}, {0, 0, 0}},
      {"rough ball of 1e6", rough, {1e6F, 1e6F, 1e6F}, {0, 0, 0}},
      {"needles", rough, {100, 1, 0.01F}, {0, 0, 0}},
      {"needles far away", rough, {100, 1, 0.01F}, {500, -300, 200}}};
  for (Body& b : bodies) b.mesh = moved(std::move(b.mesh), b.scale, b.offset);
  return bodies;
}

/// From near the middle to a vertex, a point on an edge, or an ulp or two from it.
Ray ray_to_edge(const Body& body, Random& random) {
  const auto& t = body.mesh.triangles[random.below(body.mesh.triangles.size())];
  const vec3 a = as_vec3(body.mesh.positions[t[0]]);
  const vec3 b = as_vec3(body.mesh.positions[t[1]]);
  const std::uint64_t kind = random.below(8);
  vec3 target = kind == 0   ? a
                : kind == 1 ? 0.5F * (a + b)
                            : a + static_cast<float>(random.number()) * (b - a);
  if (kind >= 5) {
    for (int i = 0; i < 3; ++i)
      target[i] = std::nextafter(target[i], random.below(2) == 0 ? far_away : -far_away);
  }
  vec3 from = as_vec3(body.offset);
  if (kind != 2) {
    for (int i = 0; i < 3; ++i)
      from[i] += 0.1F * body.scale.at(static_cast<std::size_t>(i)) *
                 static_cast<float>(random.number() - 0.5);
  }
  return ray_to(from, target);
}

/// Counts the rays from within bodies that do not hit them.
Finding leaks(Bench& bench, const std::vector<Body>& bodies, std::uint64_t count) {
  const std::uint64_t each = count / bodies.size() + 1;
  Finding finding;
  std::vector<Ray> rays;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Body& body = bodies[k];
    RayTarget target(bench, body.mesh);
    for (std::uint64_t done = 0; done < each; done += rays.size()) {
      rays.resize(std::min<std::uint64_t>(RayTarget::most_rays, each - done));
      parallel_for(rays.size(), 1U << 12U, [&](std::size_t begin, std::size_t end) {
        Random random((k << 48U) + done + begin);
        for (std::size_t i = begin; i < end; ++i) rays[i] = ray_to_edge(body, random);
      });
      const auto note = [&](std::size_t i, bool hit) {
        finding.count(1, hit ? 0 : 1,
                      [&] { return fmt::format("{}, {}", body.name, ray_text(rays[i])); });
      };
      const std::size_t half = rays.size() / 2;
      const std::vector<bool> any = target.any(std::span(rays).first(half));
      const std::vector<shared::HitRecord> closest = target.closest(std::span(rays).subspan(half));
      for (std::size_t i = 0; i < any.size(); ++i) note(i, any[i]);
      for (std::size_t i = 0; i < closest.size(); ++i)
        note(half + i, closest[i].triangle != shared::NONE);
      bench.tell((static_cast<double>(k) + static_cast<double>(done) / static_cast<double>(each)) /
                 static_cast<double>(bodies.size()));
    }
  }
  return finding;
}

Check leak_check() {
  Check check = ray_row(
      "closed meshes have no leaks",
      "a billion rays (2 M where quick) from within to vertices and edges, and an ulp beside them, "
      "half of them shadow rays: balls, even, rough, tiny, huge, far away, of needles",
      "rays that leak", 0);
  check.measure = [](Bench& bench) {
    return leaks(bench, closed_bodies(), bench.quick() ? 1U << 21U : 1'000'000'000);
  };
  return check;
}

Check needle_leak_check() {
  Check check = ray_row("needles of a millionth", "the same of a rough ball of 1000 x 1 x 0.001",
                        "rays that leak", 0);
  check.argued =
      "Its triangles are seen narrower than 2^-24 of their length, and the products that tell on "
      "which side of their edges a ray passes are equal in float. The reference forms them again "
      "in double.";
  check.measure = [](Bench& bench) {
    const Vector3 scale{1000, 1, 0.001F};
    return leaks(bench, {{"needles", moved(rough_ball(), scale, {}), scale, {}}},
                 bench.quick() ? 1U << 18U : 1U << 24U);
  };
  return check;
}

/// Origins and directions of whole numbers, at whose vertices, edges and diagonals every hit has a
/// distance that floats hold.
std::vector<Ray> lattice_rays(int half) {
  std::vector<Ray> rays;
  std::vector<vec3> directions;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) directions.emplace_back(x, y, z);
      }
    }
  }
  for (const float zero : {0.0F, -0.0F}) {
    for (vec3 d : directions) {
      for (int i = 0; i < 3; ++i) d[i] = d[i] == 0 ? zero : d[i];
      for (int x = -2 * half + 1; x < 2 * half; ++x) {
        for (int y = -2 * half + 1; y < 2 * half; ++y) {
          for (int z = -2 * half + 1; z < 2 * half; z += 3)
            rays.push_back({vec4(0.5F * vec3(x, y, z), 0), vec4(d, far_away)});
        }
      }
    }
  }
  return rays;
}

/// The cube of half length `half`, seen from inside, its faces in squares of side 1.
TriangleMesh lattice(int half) {
  TriangleMesh cube;
  const TriangleMesh face = grid(2 * half, 1, false);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      TriangleMesh turned = face;
      for (Vector3& p : turned.positions) {
        Vector3 q{};
        q.at(axis) = static_cast<float>(half) * side;
        q.at((axis + 1) % 3) = static_cast<float>(half) * p[0];
        q.at((axis + 2) % 3) = static_cast<float>(half) * p[2];
        p = q;
      }
      append(cube, turned);
    }
  }
  return cube;
}

Check lattice_check() {
  Check check = ray_row("rays along axes and diagonals",
                        "from whole and half coordinates in a cube of unit squares, through its "
                        "vertices and edges and along them, components 0 and -0",
                        "hits at another than the exact distance", 0);
  check.measure = [](Bench& bench) {
    constexpr int half = 8;
    RayTarget target(bench, lattice(half));
    const std::vector<Ray> all = lattice_rays(half);
    Finding finding;
    for (std::size_t first = 0; first < all.size(); first += RayTarget::most_rays) {
      const std::span<const Ray> rays = std::span(all).subspan(
          first, std::min<std::size_t>(RayTarget::most_rays, all.size() - first));
      const std::vector<shared::HitRecord> hits = target.closest(rays);
      const std::vector<bool> any = target.any(rays);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        float right = far_away;
        for (int axis = 0; axis < 3; ++axis) {
          if (rays[i].direction[axis] != 0)
            right = std::min(
                right, static_cast<float>(half) - rays[i].origin[axis] * rays[i].direction[axis]);
        }
        const bool exact = any[i] && hits[i].triangle != shared::NONE && hits[i].t == right;
        finding.count(1, exact ? 0 : 1, [&] { return ray_text(rays[i]); });
      }
    }
    return finding;
  };
  return check;
}

}  // namespace

std::vector<Check> leak_checks() { return {leak_check(), needle_leak_check(), lattice_check()}; }

}  // namespace facet::extremes
