// Rays that leave surfaces: bodies that shadow themselves, surfaces that all but touch.
#include <fmt/format.h>

#include <cmath>

#include "extremes/scene_parts.h"
#include "shared/extreme_inputs.h"

namespace facet::extremes {

namespace {

Check surface_row(const char* name, const char* range, const char* unit, double limit) {
  return make_check("surfaces", name, range, unit, limit);
}

Vector3 scaled(float s, const Vector3& v) { return {s * v[0], s * v[1], s * v[2]}; }

Vector3 sum(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

constexpr const char* too_near =
    "A ray leaves a surface from beyond 16 times 2^-24 of its largest coordinate, which is what "
    "floats do not resolve there (docs/reference/sampling.md, \"Ray offset\"). What lies nearer is "
    "not seen.";

/// A body alone, seen from outside; its front glows, or not.
ScenePtr alone(const TriangleMesh& body, const LookAt& view, double fov, bool glows = false) {
  SceneMaker maker;
  maker.sampler({"independent", {{"sampleCount", 16}}});
  maker.camera(camera({64, 64}, fov, view));
  const Plugin black{"diffuse", {{"albedo", gray(0)}}};
  if (glows) {
    maker.mesh(body, black, {"area", {{"radiance", gray(1)}}});
  } else {
    maker.mesh(body, black);
  }
  return maker.scene();
}

Rendered seen_by(Bench& bench, const ScenePtr& scene, const char* integrator) {
  RenderRequest request;
  request.samples = bench.quick() ? 16 : 1024;
  request.integrator = integrator;
  return rendered(bench, scene, request);
}

std::string text_of_leaving(std::uint32_t index) {
  const glm::vec4 n = shared::leaving_numbers(index);
  return fmt::format("{}, weights {:.9g} and {:.9g}, cosine {:.9g}, azimuth {:.9g} turns",
                     triangle_text(index), n.x, n.y, n.z, n.w);
}

Check leaving_check() {
  Check check = surface_row(
      "offset of rays that leave a triangle",
      "triangles of sizes 2^-14 to 2, by the origin and up to 2^14 sizes away, needles to a width "
      "of 2^-13, ones in a plane of the axes; points at edges and corners, directions grazing",
      "share that rounding uses up", 0.6);
  check.measure = [](Bench& bench) {
    constexpr std::array inputs{WordRange{0, 1U << 28U}};
    const Worst worst = bench.sweep(Kernel::functions, shared::FUNCTION_OFFSET_USED, inputs,
                                    [](std::uint32_t /*index*/, std::uint32_t used) {
                                      return std::max(0.0, static_cast<double>(as_float(used)));
                                    });
    return Finding{worst.inputs(), worst.value(), text_of_leaving(worst.word())};
  };
  return check;
}

float round_radius(const Vector3& /*direction*/) { return 1; }

/// Calls body(alone, glowing, name) for scenes of convex bodies of many sizes and places.
template <typename Body>
void for_each_convex_body(const Body& body) {
  struct Shape {
    const char* name;
    TriangleMesh mesh;
  };
  const std::vector<Shape> shapes = {
      {"ball of 32", ball(1, round_radius)},
      {"ball of 8192", ball(5, round_radius)},
      {"ellipsoid", moved(ball(5, round_radius), {1, 0.03F, 0.001F}, {})}};
  for (const float size : {1e-6F, 1.0F, 1e6F}) {
    for (const Vector3& place : {Vector3{0, 0, 0}, Vector3{1, 0, 0}, Vector3{300, -1000, 50}}) {
      for (const Shape& shape : shapes) {
        const Vector3 middle = scaled(size, place);
        const LookAt view{.origin = sum(middle, scaled(size, {2, 1.5F, -2})), .target = middle};
        const TriangleMesh mesh = moved(shape.mesh, {size, size, size}, middle);
        body(alone(mesh, view, 40), alone(mesh, view, 40, true),
             fmt::format("{}, {:g} large, {:g} sizes from the origin", shape.name, size,
                         std::hypot(place[0], place[1], place[2])));
      }
    }
  }
}

constexpr const char* convex_bodies =
    "balls of 32 and 8192 triangles and an ellipsoid of needles, 1e-6 to 1e6 large, up to 1000 "
    "sizes from the origin";

Check self_shadow_check() {
  Check check = surface_row("convex bodies do not shadow themselves", convex_bodies,
                            "rays from their front to the sky that are blocked", 0);
  check.measure = [](Bench& bench) {
    Finding finding;
    for_each_convex_body(
        [&](const ScenePtr& body, const ScenePtr& glowing, const std::string& name) {
          const Rendered front = seen_by(bench, glowing, "direct_mats");
          const Rendered sky = seen_by(bench, body, "ao");
          std::uint64_t blocked = 0;
          for (std::size_t i = 0; i < front.film.pixels.size(); ++i) {
            const std::uint64_t all = front.film.pixels[i].nonzero;
            blocked += all - std::min<std::uint64_t>(all, sky.film.pixels[i].nonzero);
          }
          finding.count(front.nonzero(), blocked, [&] { return name; });
        });
    return finding;
  };
  return check;
}

Check behind_check() {
  Check check = surface_row("convex bodies show their front", convex_bodies,
                            "rays that hit a triangle from behind", 0);
  check.argued =
      "A ray within a rounding of an edge of the silhouette may meet either triangle beside the "
      "edge, and none passes between them: the one that faces away is what keeps meshes without "
      "leaks.";
  check.measure = [](Bench& bench) {
    Finding finding;
    for_each_convex_body(
        [&](const ScenePtr& body, const ScenePtr& glowing, const std::string& name) {
          const std::uint64_t hits = seen_by(bench, body, "depth").nonzero();
          finding.count(hits, hits - seen_by(bench, glowing, "direct_mats").nonzero(),
                        [&] { return name; });
        });
    return finding;
  };
  return check;
}

TriangleMesh smooth_ball() {
  TriangleMesh mesh = ball(3, round_radius);
  mesh.normals = mesh.positions;
  return mesh;
}

constexpr LookAt view_from_afar{.origin = {302, -998.5F, 48}, .target = {300, -1000, 50}};
constexpr LookAt view_of_ball{.origin = {2, 1.5F, -2}, .target = {0, 0, 0}};

Check terminator_check() {
  Check check =
      surface_row("shadow terminators", "a ball of 512 triangles with the normals of a sphere",
                  "share of light that is lost to its own triangles", 0);
  check.argued =
      "Directions above the shading normal's horizon and below the triangle's are inside the body: "
      "its triangles are what the scene says, and they are opaque. Finer meshes lose less.";
  check.measure = [](Bench& bench) {
    const ScenePtr scene = alone(smooth_ball(), view_of_ball, 40);
    const std::uint64_t hits = seen_by(bench, scene, "depth").nonzero();
    const std::uint64_t dark = hits - seen_by(bench, scene, "ao").nonzero();
    Finding finding;
    finding.add(static_cast<double>(dark) / static_cast<double>(hits),
                [&] { return fmt::format("{} of {} rays", dark, hits); });
    finding.inputs = hits;
    return finding;
  };
  return check;
}

/// A black floor below a pane that light passes, both of side 2, `gap` roundings of 1 apart, and a
/// bright sky, which nothing sees but what passes the floor.
ScenePtr pane(int gap, bool tilted) {
  const float floor_height = 1 - static_cast<float>(gap) * 0x1p-24F;
  const auto turned = [tilted](TriangleMesh mesh) {
    for (Vector3& p : mesh.positions) {
      if (tilted) p = {0.8F * p[0] - 0.6F * p[1], 0.6F * p[0] + 0.8F * p[1], p[2]};
    }
    return mesh;
  };
  const Vector3 eye = tilted ? Vector3{-1.5F, 2.5F, 1} : Vector3{0.5F, 3, 1};
  const Vector3 target = tilted ? Vector3{-0.6F, 0.8F, 0} : Vector3{0, 1, 0};
  SceneMaker maker;
  maker.integrator({"path_mats", {{"maxDepth", 4}}});
  maker.sampler({"independent", {{"sampleCount", 16}}});
  maker.camera(camera({64, 64}, 10, {.origin = eye, .target = target}));
  maker.emitter({"environment"});
  maker.mesh(turned(grid(4, 1, true)), {"dielectric", {{"intIOR", 1.0}, {"extIOR", 1.0}}});
  maker.mesh(turned(grid(3, floor_height, true)), {"diffuse", {{"albedo", gray(0)}}});
  return maker.scene();
}

Check gap_check(const char* name, std::vector<int> gaps, const char* argued) {
  Check check = surface_row(name, "a pane over a floor, level and tilted, 1 from the origin",
                            "samples that see through the floor", 0);
  check.argued = argued;
  check.measure = [gaps = std::move(gaps)](Bench& bench) {
    Finding finding;
    for (const int gap : gaps) {
      for (const bool tilted : {false, true}) {
        const Rendered r = rendered(bench, pane(gap, tilted));
        finding.inputs += r.statistics.samples - 1;
        finding.add(static_cast<double>(r.nonzero()),
                    [&] { return fmt::format("{} apart, {}", gap, tilted ? "tilted" : "level"); });
      }
    }
    return finding;
  };
  return check;
}

/// Under an even sky, seen by path_mis.
SceneMaker under_the_sky(const LookAt& view) {
  SceneMaker maker;
  maker.integrator({"path_mis", {{"maxDepth", 4}}});
  maker.sampler({"independent", {{"sampleCount", 16}}});
  maker.camera(camera({32, 24}, 40, view));
  maker.emitter({"environment"});
  return maker;
}

ScenePtr lit(const TriangleMesh& body, const LookAt& view) {
  return under_the_sky(view).mesh(body, {"roughsubstrate", {{"alpha", 0.1}}}).scene();
}

/// Which of the two a ray hits, rounding decides.
ScenePtr two_in_one() {
  SceneMaker maker = under_the_sky(view_of_ball);
  for (const float albedo : {1.0F, 0.0F})
    maker.mesh(ball(2, round_radius), {"diffuse", {{"albedo", gray(albedo)}}});
  return maker.scene();
}

}  // namespace

std::vector<EdgeScene> surface_scenes() {
  return {
      {"a ball with the normals of a sphere", [] { return lit(smooth_ball(), view_of_ball); }},
      {"an ellipsoid of needles",
       [] {
         return lit(moved(ball(5, round_radius), {1, 0.03F, 0.001F}, {}), view_of_ball);
       }},
      {"a ball 1000 sizes from the origin",
       [] {
         return lit(moved(ball(3, round_radius), {1, 1, 1}, {300, -1000, 50}), view_from_afar);
       }},
      {"a pane 64 times 2^-24 over a floor", [] { return pane(64, true); }},
      {"a pane 4 times 2^-24 over a floor", [] { return pane(4, false); }, too_near},
      {"a white ball and a black one in one place", [] { return two_in_one(); },
       "Which of two faces in one place a ray hits is decided by the last bit of a distance, "
       "which kernels and reference form differently. Every such sample is explained by that."}};
}

std::vector<Check> surface_checks() {
  return {leaving_check(),
          self_shadow_check(),
          behind_check(),
          terminator_check(),
          gap_check("surfaces 32 to 1024 times 2^-24 apart", {32, 64, 256, 1024}, ""),
          gap_check("surfaces 1 to 24 times 2^-24 apart", {1, 2, 4, 8, 16, 24}, too_near)};
}

}  // namespace facet::extremes
