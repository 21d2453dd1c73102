// scene_in_memory OUT.png: a copper pyramid under a square lamp, without a file.
#include <facet/facet.h>

#include <cstdio>

namespace {

/// Two triangles.
facet::TriangleMesh quad(const facet::Vector3& a, const facet::Vector3& b, const facet::Vector3& c,
                         const facet::Vector3& d) {
  return {.positions = {a, b, c, d}, .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

facet::ScenePtr make_scene() {
  const facet::TriangleMesh pyramid{
      .positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, {0, 1.2F, 0}},
      .triangles = {{1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}}};
  facet::SceneMaker maker;
  maker.integrator({"path_mis"});
  maker.sampler({"sobol", {{"sampleCount", 64}}});
  maker.camera({"perspective",
                {{"width", 160},
                 {"height", 120},
                 {"fov", 40.0},
                 {"toWorld", facet::LookAt{.origin = {2, 2.5F, -4}, .target = {0, 0.3F, 0}}}}});
  maker.mesh(quad({-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}),
             {"diffuse", {{"albedo", facet::Rgb{0.5F, 0.5F, 0.5F}}}});
  maker.mesh(pyramid, {"roughconductor", {{"alpha", 0.2}, {"material", "Cu"}}});
  maker.mesh(quad({-1, 4, -1}, {1, 4, -1}, {1, 4, 1}, {-1, 4, 1}), {"diffuse"},
             {"area", {{"radiance", facet::Rgb{10, 9, 8}}}});
  return maker.scene({.strict = true});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage: scene_in_memory OUT.png\n", stderr), 2;
  try {
    facet::write_image(argv[1], facet::open_backend()->render(make_scene()));
  } catch (const facet::Error& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
}
