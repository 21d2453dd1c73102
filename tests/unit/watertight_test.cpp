// No ray leaks out of a closed mesh, and no body shadows itself, whatever the shape of its
// triangles.
#include <cmath>
#include <functional>
#include <numbers>

#include "support/render.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

std::uint64_t count_nonzero(const Film& film) {
  std::uint64_t nonzero = 0;
  for (const PixelSums& pixel : film.pixels) nonzero += pixel.nonzero;
  return nonzero;
}

/// Rays from inside a closed mesh that do not hit it.
std::uint64_t count_leaks(Mesh mesh, const dvec3& camera, const std::string& integrator, int spp) {
  Scene scene = make_scene(integrator);
  add_mesh(scene, std::move(mesh), bsdf::Diffuse{});
  set_camera(scene, 500, 150, camera, camera + dvec3(0.3, 0.2, 1));
  RenderSettings settings = whole_image(scene, spp);
  settings.variance = false;
  const Rendered r = render(scene, settings);
  const std::uint64_t nonzero = count_nonzero(r.film);
  // depth is 0 for a miss; ambient occlusion is 0 for a hit.
  return integrator == "depth" ? r.statistics.samples - nonzero : nonzero;
}

TEST(Watertight, no_camera_ray_leaks_in_10_million) {
  EXPECT_EQ(count_leaks(make_sphere(6, true), {0.01, 0.02, 0.03}, "depth", 14), 0U);
  EXPECT_EQ(count_leaks(make_room(50), {0, 0, 0}, "depth", 14), 0U);
  Mesh far = make_sphere(5, true);
  transform(far, 1, {1000, 2000, -500});
  EXPECT_EQ(count_leaks(far, {1000, 2000, -500}, "depth", 14), 0U);
}

TEST(Watertight, no_shadow_ray_leaks_out_of_a_ball) {
  EXPECT_EQ(count_leaks(make_sphere(5, true), {0.01, 0.02, 0.03}, "ao", 10), 0U);
}

/// Samples of a scene whose integrator's value is not 0.
using Count = std::function<std::uint64_t(const Scene&)>;

Count by_kernels(int spp) {
  return [spp](const Scene& scene) {
    RenderSettings settings = whole_image(scene, spp);
    settings.variance = false;
    return count_nonzero(render(scene, settings).film);
  };
}

Count by_reference(int spp) {
  return [spp](const Scene& scene) {
    return count_nonzero(render_reference(scene, whole_image(scene, spp), Precision::float_));
  };
}

/// Samples that hit a body, of which there are at least so many, and do not see its sky.
std::uint64_t count_dark(Scene scene, const Count& count, std::uint64_t least) {
  set_integrator(scene, "depth");
  const std::uint64_t hits = count(scene);
  EXPECT_GT(hits, least);
  set_integrator(scene, "ao");
  return hits - count(scene);
}

Scene alone(const Mesh& mesh) {
  Scene scene = make_scene("depth");
  add_mesh(scene, mesh, bsdf::Diffuse{});
  return scene;
}

TEST(SelfIntersection, a_convex_body_never_shadows_itself) {
  for (const float size : {1e-6F, 1.0F, 1e6F}) {
    for (const vec3& centre :
         {vec3(0), vec3(size, 0, 0), vec3(300 * size, -1000 * size, 50 * size)}) {
      for (Mesh mesh : {make_sphere(1, false), make_sphere(5, false)}) {
        transform(mesh, size, centre);
        Scene scene = alone(mesh);
        const dvec3 middle(centre);
        set_camera(scene, 300, 40, middle + static_cast<double>(size) * dvec3(2, 1.5, -2), middle);
        EXPECT_EQ(count_dark(scene, by_kernels(10), 100000), 0U)
            << size << " at " << centre.x << ", " << mesh.positions.size();
      }
    }
  }
}

/// Planes through the origin, whose coordinates vanish, at every tilt.
TEST(SelfIntersection, a_plane_through_the_origin_never_shadows_itself) {
  for (int i = 0; i < 12; ++i) {
    const double angle = 0.05 + 0.13 * i;
    const vec3 u(std::cos(angle), std::sin(angle), 0);
    const vec3 v(0, i % 3, 1);
    const dvec3 n = glm::normalize(glm::cross(dvec3(v), dvec3(u)));
    Scene scene = alone(make_quad(-u - v, u - v, u + v, -u + v));
    set_camera(scene, 100, 20, 3.0 * n, {0, 0, 0}, {0.1, 0.2, 0.3});
    EXPECT_EQ(count_dark(scene, by_kernels(16), 10000), 0U) << i;
  }
}

/// A rotation about an axis that no triangle knows.
vec3 tilted(const vec3& p) {
  const vec3 q(p.x, 0.7648F * p.y - 0.6442F * p.z, 0.6442F * p.y + 0.7648F * p.z);
  return {0.9211F * q.x + 0.3894F * q.z, q.y, 0.9211F * q.z - 0.3894F * q.x};
}

/// The side of a pole of 16 faces and height 10.
Mesh make_pole(float radius) {
  std::vector<vec3> corners;
  const auto at = [radius](int i, float z) {
    const double phi = 2 * std::numbers::pi * (i % 16) / 16;
    return vec3(radius * std::cos(phi), radius * std::sin(phi), z);
  };
  for (int i = 0; i < 16; ++i) {
    corners.insert(corners.end(), {at(i, -5), at(i + 1, -5), at(i + 1, 5)});
    corners.insert(corners.end(), {at(i, -5), at(i + 1, 5), at(i, 5)});
  }
  return make_mesh(corners);
}

/// The square of side 1 in the plane z = 0, tilted, in strips along y. flat: each is cut so that it
/// has triangles whose third corner nearly lies on the opposite edge; else by a diagonal.
Scene strips(int count, bool flat) {
  std::vector<vec3> corners;
  for (int i = 0; i < count; ++i) {
    const float left = static_cast<float>(i) / static_cast<float>(count) - 0.5F;
    const float right = static_cast<float>(i + 1) / static_cast<float>(count) - 0.5F;
    const vec3 a = tilted({left, -0.5F, 0});
    const vec3 b = tilted({right, -0.5F, 0});
    const vec3 c = tilted({right, 0.5F, 0});
    const vec3 d = tilted({left, 0.5F, 0});
    const vec3 middle = tilted({right, 0, 0});
    if (flat) {
      corners.insert(corners.end(), {a, middle, d, a, b, middle, d, middle, c});
    } else {
      corners.insert(corners.end(), {a, b, c, a, c, d});
    }
  }
  Scene scene = alone(make_mesh(corners));
  set_camera(scene, 48, 12, tilted({0.9F, 0.4F, 2}), {0, 0, 0}, tilted({0, 0.1F, 1}));
  return scene;
}

// The weights of a hit err by 2^-24 times the triangle's length over its width: where these told
// the distance, a pole of radius 0.05 lost 4 % of its light to itself, a sheet of 1000 strips 14 %.
TEST(SelfIntersection, thin_triangles_never_shadow_themselves) {
  for (const int count : {100, 300, 1000, 10000})
    EXPECT_EQ(count_dark(strips(count, false), by_kernels(16), 10000), 0U) << count << " strips";
  EXPECT_EQ(count_dark(strips(1000, false), by_reference(8), 10000), 0U) << "reference";
  for (const int count : {100, 500})
    EXPECT_EQ(count_dark(strips(count, true), by_kernels(16), 10000), 0U)
        << count << " flat strips";
  for (const float radius : {0.05F, 0.01F}) {
    for (const bool tilt : {false, true}) {
      Mesh mesh = make_pole(radius);
      if (tilt) {
        for (vec3& p : mesh.positions) p = tilted(p);
      }
      Scene scene = alone(mesh);
      const vec3 eye = tilt ? tilted(vec3(24, 16, 0) * radius) : vec3(24, 16, 0) * radius;
      set_camera(scene, 64, 4, dvec3(eye), {0, 0, 0},
                 tilt ? dvec3(tilted({0, 0, 1})) : dvec3(0, 0, 1));
      EXPECT_EQ(count_dark(scene, by_kernels(16), 10000), 0U) << radius << " " << tilt;
    }
  }
}

TEST(SelfIntersection, a_needle_alone_never_shadows_itself) {
  Scene scene = make_scene("ao");
  add_mesh(scene, make_mesh({{-3, -4, 0}, {3, 4, 0}, {3, 4, 0.02F}}), bsdf::Diffuse{});
  set_camera(scene, 8, 0.3, {2, 0.9, 0.007}, {1.2, 1.5, 0.007}, {0, 0, 1});
  const Film film = render(scene, 4096).film;
  EXPECT_EQ(film.pixels[4 * 8 + 4].nonzero, 4096U);
}

}  // namespace
}  // namespace facet::test
