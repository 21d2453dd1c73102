// The kernels' hits against brute force in double precision, and watertightness.
#include <algorithm>
#include <cmath>
#include <random>

#include "render/ray_tracer.h"
#include "support/brute_force.h"
#include "support/render.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

class ShippedScene : public testing::TestWithParam<const char*> {};

TEST_P(ShippedScene, camera_rays_hit_what_brute_force_hits) {
  Scene scene = load_scene(GetParam());
  const double aspect = static_cast<double>(scene.camera.height) / scene.camera.width;
  scene.camera.width = 48;
  scene.camera.height = static_cast<int>(48 * aspect);
  expect_right_hits(scene, 1e-4, 500);
}

INSTANTIATE_TEST_SUITE_P(Traversal, ShippedScene,
                         testing::Values("cbox/cbox_conductors_mis.xml",
                                         "veach_mi/veach_mi_mis.xml",
                                         "serapis/serapis_rough_mis.xml",
                                         "furnace/furnace_050.xml"));

Scene triangle_soup(std::uint32_t seed, int count, float size, float stretch) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto next = [&] {
    const float x = uniform(engine);
    const float y = uniform(engine);
    const float z = uniform(engine);
    return vec3(x, y, z);
  };
  std::vector<vec3> corners;
  for (int i = 0; i < count; ++i) {
    const vec3 centre = next();
    for (int k = 0; k < 3; ++k)
      corners.push_back(centre + next() * vec3(size, size * stretch, size / stretch));
  }
  Scene scene = make_scene("normals");
  add_mesh(scene, make_mesh(corners), bsdf::Diffuse{});
  set_camera(scene, 48, 60, {0.1, 0.2, -3}, {0, 0, 0});
  return scene;
}

TEST(Traversal, random_soup) { expect_right_hits(triangle_soup(1, 20000, 0.05F, 1), 1e-4, 1000); }
TEST(Traversal, needles) { expect_right_hits(triangle_soup(2, 5000, 0.05F, 20), 1e-4, 1000); }
TEST(Traversal, huge_triangles_through_each_other) {
  expect_right_hits(triangle_soup(3, 300, 10, 1), 1e-4, 1000);
}

/// Squares of two triangles whose vertices are in every order, so that any edge is the common one,
/// wound any way.
TEST(Traversal, pairs_of_triangles_in_every_order) {
  std::array<int, 3> p{0, 1, 2};
  std::vector<vec3> corners;
  std::size_t squares = 0;
  do {
    std::array<int, 3> q{0, 2, 3};
    do {
      const std::size_t column = squares % 6;
      const std::size_t row = squares / 6;
      const vec3 at(static_cast<float>(column), static_cast<float>(row), 0);
      ++squares;
      const std::array<vec3, 4> square{vec3(0, 0, 0), vec3(0.9F, 0, 0.1F), vec3(0.9F, 0.9F, 0),
                                       vec3(0, 0.9F, 0.2F)};
      for (const std::array<int, 3>& triangle : {p, q}) {
        for (const int k : triangle) corners.push_back(at + square[static_cast<std::size_t>(k)]);
      }
    } while (std::ranges::next_permutation(q).found);
  } while (std::ranges::next_permutation(p).found);
  Scene scene = make_scene("normals");
  add_mesh(scene, make_mesh(corners), bsdf::Diffuse{});
  set_camera(scene, 96, 60, {3, 3, -6}, {3, 3, 0});
  const PackedScene packed = pack_scene(scene, whole_image(scene, 1));
  const auto is_pair = [](const shared::PairRecord& pair) { return pair.name1 != 0; };
  EXPECT_EQ(std::ranges::count_if(packed.pairs, is_pair), static_cast<std::ptrdiff_t>(squares));
  expect_right_hits(scene, 1e-4, 3000);
}

TEST(Traversal, triangles_name_their_meshes_even_in_pairs_of_two_meshes) {
  Scene scene = make_scene("normals");
  // Squares in a row, the halves of each in two meshes, and a triangle apart.
  std::array<std::vector<vec3>, 2> halves;
  for (int i = 0; i < 20; ++i) {
    const vec3 at(2.0F * static_cast<float>(i), 0, 0);
    for (const vec3& c : {vec3(0, 0, 0), vec3(1, 0, 0), vec3(1, 1, 0)}) halves[0].push_back(at + c);
    for (const vec3& c : {vec3(0, 0, 0), vec3(1, 1, 0), vec3(0, 1, 0)}) halves[1].push_back(at + c);
  }
  for (const std::vector<vec3>& half : halves) add_mesh(scene, make_mesh(half), bsdf::Diffuse{});
  add_mesh(scene, make_mesh({{0, 5, 0}, {1, 5, 0}, {0, 6, 0}}), bsdf::Diffuse{});
  const PackedScene packed = pack_scene(scene, whole_image(scene, 1));
  ASSERT_EQ(packed.triangle_count(), 41U);
  std::size_t mixed_pairs = 0;
  for (const std::uint32_t place : packed.bvh.places) {
    const shared::PairRecord& pair = packed.pairs[place / 2];
    const std::uint32_t mesh = place % 2 == 0 ? pair.mesh0 : pair.mesh1;
    EXPECT_EQ(mesh, packed.scene_index(place) / 20);
    mixed_pairs += pair.name1 != 0 && pair.mesh0 != pair.mesh1 ? 1 : 0;
  }
  EXPECT_GT(mixed_pairs, 20U);
}

TEST(Traversal, a_thousand_coincident_triangles) {
  Scene scene = make_scene("normals");
  std::vector<vec3> corners;
  for (int i = 0; i < 1000; ++i)
    corners.insert(corners.end(), {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}});
  add_mesh(scene, make_mesh(corners), bsdf::Diffuse{});
  set_camera(scene, 32, 40, {0, 0, -3}, {0, 0, 0});
  expect_right_hits(scene, 1e-4, 100);
}

TEST(Traversal, triangles_without_area_are_not_there) {
  Scene scene = make_scene("normals");
  add_mesh(scene,
           make_mesh({{-1, -1, 0},
                      {1, 1, 0},
                      {0, 0, 0},
                      {1, 1, 1},
                      {1, 1, 1},
                      {1, 1, 1},
                      {-1, -1, 1},
                      {1, -1, 1},
                      {0, 1, 1}}),
           bsdf::Diffuse{});
  set_camera(scene, 32, 60, {0, 0, -3}, {0, 0, 0});
  EXPECT_EQ(pack_scene(scene, whole_image(scene, 1)).triangle_count(), 1U);
  expect_right_hits(scene, 1e-4, 50);
}

TEST(Traversal, an_empty_scene_is_missed) {
  Scene scene = make_scene("normals");
  set_camera(scene, 16, 60, {0, 0, -3}, {0, 0, 0});
  EXPECT_EQ(compare_with_brute_force(scene, 1e-4).hits, 0U);
}

TEST(Traversal, sizes_from_1e_6_to_1e6) {
  for (const float scale : {1e-6F, 1e-3F, 1e3F, 1e6F}) {
    Scene scene = triangle_soup(4, 3000, 0.1F, 1);
    transform(scene.meshes[0], scale, vec3(0));
    scene.camera.to_world[3] *= glm::dvec4(scale, scale, scale, 1);
    expect_right_hits(scene, 1e-4, 1000);
  }
}

TEST(Traversal, big_and_tiny_triangles_together) {
  Scene scene = triangle_soup(5, 3000, 0.1F, 1);
  Mesh tiny = scene.meshes[0];
  transform(tiny, 1e-4F, {0.3F, 0.1F, 0});
  add_mesh(scene, tiny, bsdf::Diffuse{});
  Mesh huge = scene.meshes[0];
  transform(huge, 1e4F, {0, 0, 1.5e4F});
  add_mesh(scene, huge, bsdf::Diffuse{});
  expect_right_hits(scene, 1e-4, 1000);
}

/// A disc of radius 1 about the origin, facing +z, whose triangles all begin at its centre.
Mesh make_fan(int count) {
  std::vector<vec3> corners;
  const auto at = [&](int i) {
    const double phi = 2 * 3.14159265358979 * i / count;
    return vec3(std::cos(phi), std::sin(phi), 0);
  };
  for (int i = 0; i < count; ++i) {
    corners.emplace_back(0);
    corners.push_back(at(i));
    corners.push_back(at(i + 1));
  }
  return make_mesh(corners);
}

/// Boxes of long triangles that point everywhere hold most of the disc: a ray would meet a quarter
/// of them, more than a traversal can visit.
TEST(Traversal, fans_are_traversed_whole_and_found_to_be_what_they_are) {
  constexpr int count = 100'000;
  Scene scene = make_scene("direct_mats");
  add_mesh(scene, make_quad({-2, -2, -1}, {2, -2, -1}, {2, 2, -1}, {-2, 2, -1}), bsdf::Diffuse{});
  add_mesh(scene, make_fan(count), bsdf::Diffuse{Color(0)}, Color(3));
  set_camera(scene, 64, 28, {0, 0, 4}, {0, 0, 0});
  const PackedScene packed = pack_scene(scene, whole_image(scene, 1));
  EXPECT_GT(packed.bvh.copies.size(), 100'000U);
  Renderer renderer(device(), packed);
  const std::vector<shared::RayRecord> rays = renderer.camera_rays();
  RayTracer tracer(device(), packed, static_cast<std::uint32_t>(rays.size()));
  tracer.set_rays(rays);
  tracer.trace_closest();
  const std::vector<shared::HitRecord> hits = tracer.hits();
  tracer.trace_any();
  const std::vector<bool> occluded = tracer.occluded();
  EXPECT_EQ(tracer.bound_hits(), 0U);
  int on_fan = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_TRUE(occluded[i]);
    const dvec3 o(rays[i].origin);
    const dvec3 d(rays[i].direction);
    const double t = -o.z / d.z;
    const dvec3 p = o + t * d;
    const double radius = std::hypot(p.x, p.y);
    if (radius > 0.99999) continue;
    ++on_fan;
    ASSERT_NEAR(hits[i].t, t, 1e-5);
    // The first two triangles are the quad's.
    const double turns = std::atan2(p.y, p.x) / (2 * 3.14159265358979);
    const double sector = (turns < 0 ? turns + 1 : turns) * count + 2;
    ASSERT_NEAR(packed.scene_index(hits[i].triangle) + 0.5, sector, 0.5 + 1e-2 / radius);
  }
  EXPECT_GT(on_fan, 3000);
  // The fan emits, wherever a leaf's copy was hit.
  const Image image = render(scene, 4).image;
  for (int y = 20; y < 44; ++y) {
    for (int x = 20; x < 44; ++x) ASSERT_EQ(image.at(x, y, 0), 3);
  }
}

}  // namespace
}  // namespace facet::test
