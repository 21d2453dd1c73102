#include "cli/selftest_scenes.h"

#include <cmath>

namespace facet::cli {

namespace {

constexpr int width = 160;
constexpr int height = 120;

TriangleMesh quad(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  return {.positions = {a, b, c, d},
          .triangles = {{0, 1, 2}, {0, 2, 3}},
          .texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
}

/// Of so many rings of quads, with normals.
TriangleMesh ball(const Vector3& center, float radius) {
  constexpr std::uint32_t rings = 24;
  constexpr std::uint32_t sectors = 48;
  constexpr double pi = 3.14159265358979323846;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= rings; ++i) {
    for (std::uint32_t k = 0; k <= sectors; ++k) {
      const double polar = pi * i / rings;
      const double azimuth = 2 * pi * k / sectors;
      const Vector3 n{static_cast<float>(std::sin(polar) * std::cos(azimuth)),
                      static_cast<float>(std::cos(polar)),
                      static_cast<float>(std::sin(polar) * std::sin(azimuth))};
      mesh.positions.push_back(
          {center[0] + radius * n[0], center[1] + radius * n[1], center[2] + radius * n[2]});
      mesh.normals.push_back(n);
      mesh.texcoords.push_back({static_cast<float>(k) / sectors, static_cast<float>(i) / rings});
      if (i == rings || k == sectors) continue;
      const std::uint32_t a = i * (sectors + 1) + k;
      const std::uint32_t b = a + sectors + 1;
      mesh.triangles.push_back({a, a + 1, b});
      mesh.triangles.push_back({a + 1, b + 1, b});
    }
  }
  return mesh;
}

Plugin camera(const LookAt& view, double fov) {
  return {"perspective", {{"width", width}, {"height", height}, {"fov", fov}, {"toWorld", view}}};
}

Plugin diffuse(float r, float g, float b) { return {"diffuse", {{"albedo", Rgb{r, g, b}}}}; }

void add_floor_and_lamp(SceneMaker& maker, const Plugin& floor) {
  maker.mesh(quad({-4, 0, -4}, {-4, 0, 4}, {4, 0, 4}, {4, 0, -4}), floor);
  maker.mesh(quad({-1, 4, -1}, {1, 4, -1}, {1, 4, 1}, {-1, 4, 1}), diffuse(0, 0, 0),
             {"area", {{"radiance", Rgb{12, 11, 9}}}});
}

}  // namespace

ScenePtr furnace_scene(double albedo) {
  const auto reflectance = static_cast<float>(albedo);
  const Plugin wall = diffuse(reflectance, reflectance, reflectance);
  const Plugin light{"area", {{"radiance", Rgb{1, 1, 1}}}};
  SceneMaker maker;
  maker.integrator({"path_mis"});
  maker.sampler({"independent", {{"sampleCount", 16}}});
  maker.camera(camera({.origin = {0.2F, 0.1F, -0.3F}, .target = {0.7F, 0.3F, 1}}, 70));
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.F, 1.F}) {
      const auto at = [&](float u, float v) {
        Vector3 p{};
        const auto k = static_cast<std::size_t>(axis);
        p[k] = side;
        p[(k + 1) % 3] = u;
        // Counter-clockwise as seen from within.
        p[(k + 2) % 3] = -side * v;
        return p;
      };
      maker.mesh(quad(at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)), wall, light);
    }
  }
  return maker.scene();
}

ScenePtr metals_scene() {
  SceneMaker maker;
  maker.integrator({"direct_mis"});
  maker.sampler({"independent", {{"sampleCount", 4}}});
  maker.camera(camera({.origin = {0, 2.5F, -6}, .target = {0, 0.8F, 0}}, 40));
  add_floor_and_lamp(maker, diffuse(0.5F, 0.5F, 0.5F));
  maker.mesh(ball({-1.1F, 1, 0}, 1), {"roughconductor", {{"alpha", 0.05}, {"material", "Au"}}});
  maker.mesh(ball({1.1F, 1, 0}, 1), {"roughconductor", {{"alpha", 0.4}, {"material", "Cu"}}});
  return maker.scene();
}

ScenePtr paths_scene() {
  SceneMaker maker;
  maker.integrator({"path_mis", {{"maxDepth", 6}}});
  maker.sampler({"sobol", {{"sampleCount", 4}}});
  maker.camera(camera({.origin = {0, 2.5F, -6}, .target = {0, 0.8F, 0}}, 40));
  maker.emitter({"environment", {{"radiance", Rgb{0.2F, 0.3F, 0.5F}}}});
  add_floor_and_lamp(maker,
                     {"diffuse",
                      {{"albedo", std::vector<Plugin>{{"checker",
                                                       {{"scalex", 8},
                                                        {"scaley", 8},
                                                        {"color1", Rgb{0.7F, 0.2F, 0.1F}},
                                                        {"color2", Rgb{0.8F, 0.8F, 0.8F}}}}}}}});
  maker.mesh(ball({-1.1F, 1.01F, 0}, 1), {"dielectric"});
  maker.mesh(ball({1.1F, 1.01F, 0}, 1),
             {"roughsubstrate", {{"alpha", 0.1}, {"kd", Rgb{0.1F, 0.3F, 0.6F}}}});
  return maker.scene();
}

}  // namespace facet::cli
