#include "bench/mesh.h"

#include <cmath>
#include <numbers>

#include "shared/random_hash.h"

namespace facet::bench {

namespace {

/// Patches of equal size: a ball's, one for each side of a cube, and as many again for the floor;
/// two triangles a cell.
constexpr std::size_t ball_sides = 6;
constexpr std::size_t floor_shares = 6;

/// Random number of a lattice point in [-1, 1].
double lattice(int x, int y, int z) {
  const glm::uvec4 words =
      shared::pcg4d({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                     static_cast<std::uint32_t>(z), 0U});
  return static_cast<double>(words.x) * 0x1p-31 - 1;
}

double smooth(double t) { return t * t * (3 - 2 * t); }

/// Value noise: lattice values, interpolated.
double noise(const dvec3& p) {
  const dvec3 base = glm::floor(p);
  const dvec3 t(smooth(p.x - base.x), smooth(p.y - base.y), smooth(p.z - base.z));
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 offset(corner & 1, corner >> 1 & 1, corner >> 2);
    double weight = 1;
    for (int a = 0; a < 3; ++a) weight *= offset[a] == 1 ? t[a] : 1 - t[a];
    const glm::ivec3 at = glm::ivec3(base) + offset;
    sum += weight * lattice(at.x, at.y, at.z);
  }
  return sum;
}

/// Noise of six octaves, folded into ridges.
double folds(const dvec3& p) {
  double sum = 0;
  double amplitude = 1;
  double frequency = 1;
  for (int octave = 0; octave < 6; ++octave) {
    sum += amplitude * (0.5 - std::abs(noise(frequency * p)));
    amplitude *= 0.5;
    frequency *= 2.03;
  }
  return sum;
}

/// A square of cells by cells quads, its vertices where `place` puts (u, v) of the unit square.
template <typename Place>
void add_patch(Mesh& mesh, std::size_t cells, const Place& place) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto row = static_cast<std::uint32_t>(cells + 1);
  for (std::size_t j = 0; j <= cells; ++j) {
    for (std::size_t i = 0; i <= cells; ++i) {
      mesh.positions.emplace_back(place(static_cast<double>(i) / static_cast<double>(cells),
                                        static_cast<double>(j) / static_cast<double>(cells)));
    }
  }
  for (std::uint32_t j = 0; j + 1 < row; ++j) {
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t a = first + j * row + i;
      mesh.position_indices.emplace_back(a, a + 1, a + row + 1);
      mesh.position_indices.emplace_back(a, a + row + 1, a + row);
    }
  }
}

dvec3 cube_side(std::size_t side, double u, double v) {
  const double x = std::tan((u - 0.5) * (std::numbers::pi / 2));
  const double y = std::tan((v - 0.5) * (std::numbers::pi / 2));
  const double sign = side % 2 == 0 ? 1 : -1;
  switch (side / 2) {
    case 0:
      return {sign, sign * x, y};
    case 1:
      return {y, sign, sign * x};
    default:
      return {sign * x, y, sign};
  }
}

Mesh make_body(std::size_t cells) {
  Mesh mesh;
  for (std::size_t side = 0; side < ball_sides; ++side) {
    add_patch(mesh, cells, [&](double u, double v) {
      const dvec3 d = glm::normalize(cube_side(side, u, v));
      return d * (0.75 + 0.25 * folds(2.5 * d));
    });
  }
  const auto floor_cells = static_cast<std::size_t>(
      std::lround(static_cast<double>(cells) * std::sqrt(static_cast<double>(floor_shares))));
  add_patch(mesh, floor_cells, [](double u, double v) {
    const dvec3 p(8 * (u - 0.5), 0, 8 * (0.5 - v));
    return p + dvec3(0, -1.15 + 0.15 * folds(0.8 * p + dvec3(7.5)), 0);
  });
  mesh.name = "body";
  return mesh;
}

/// A square of the light's plane, its lower corner at (x, z), cut into cells.
Mesh make_light(double x, double z, double side, std::size_t cells) {
  Mesh mesh;
  add_patch(mesh, cells, [=](double u, double v) { return dvec3(x + side * u, 4, z + side * v); });
  mesh.name = "light";
  return mesh;
}

void add_light(Scene& scene, Mesh light) {
  const auto mesh = static_cast<std::uint32_t>(scene.meshes.size());
  light.emitter = static_cast<std::uint32_t>(scene.emitters.size());
  scene.meshes.push_back(std::move(light));
  scene.emitters.emplace_back(AreaEmitter{mesh, Color(20)});
}

void add_lights(Scene& scene, std::size_t emitters) {
  if (emitters == 0) return add_light(scene, make_light(-1, -1, 2, 1));
  constexpr std::size_t cells = 64;
  const auto row = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(emitters))));
  const double side = 2.0 / static_cast<double>(row);
  for (std::size_t i = 0; i < emitters; ++i) {
    const std::size_t column = i % row;
    const std::size_t line = i / row;
    const double x = -1 + side * static_cast<double>(column);
    const double z = -1 + side * static_cast<double>(line);
    add_light(scene, make_light(x, z, side, cells / row));
  }
}

}  // namespace

Scene generate_scene(std::size_t triangles, std::size_t emitters) {
  Scene scene;
  const double share = static_cast<double>(triangles) / (2 * (ball_sides + floor_shares));
  const auto cells =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(std::sqrt(share))));
  scene.meshes = {make_body(cells)};
  scene.bsdfs = {bsdf::Diffuse{}};
  add_lights(scene, emitters);
  scene.integrator.type = find_integrator_type("path_mis").value();
  const dvec3 eye(2.4, 1.3, -3.1);
  const dvec3 forward = glm::normalize(dvec3(0, -0.25, 0) - eye);
  const dvec3 right = glm::normalize(glm::cross(dvec3(0, 1, 0), forward));
  scene.camera.to_world = dmat4(glm::dvec4(right, 0), glm::dvec4(glm::cross(forward, right), 0),
                                glm::dvec4(forward, 0), glm::dvec4(eye, 1));
  scene.camera.width = 512;
  scene.camera.height = 512;
  scene.camera.fov = 35;
  return scene;
}

std::string generated_name(std::size_t triangles) {
  if (triangles % 1'000'000 == 0) return fmt::format("generated-{}M", triangles / 1'000'000);
  if (triangles % 1000 == 0) return fmt::format("generated-{}k", triangles / 1000);
  return fmt::format("generated-{}", triangles);
}

}  // namespace facet::bench
