// Guards against what the two renderers could share: numbers, and a density that is wrong in both.
#include "statistics/hypothesis.h"
#include "support/parity.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

/// Of each family of tests together; Sidak's correction shares it among them.
constexpr double significance = 0.01;

double share_of_significance(std::size_t tests) {
  return statistics::sidak_significance(significance, tests);
}

Image reference_image(const Scene& scene, const RenderSettings& settings) {
  return develop(render_reference(scene, settings, Precision::float_), true);
}

class Seeds : public ::testing::TestWithParam<std::string> {};

// The numbers are shared, so that parity can compare samples: with different seeds they are not.
TEST_P(Seeds, kernels_and_reference_agree_under_different_seeds) {
  Scene scene = load_scene(GetParam());
  scene.camera.height = scene.camera.height * 48 / scene.camera.width;
  scene.camera.width = 48;
  // Samples of direct light alone need company until every cell has enough contributions to test.
  const bool direct = scene.integrator.interaction_limit() == 1;
  // So do those of the few paths that glass and mirrors let through to the panel.
  const bool smooth = GetParam().starts_with("materials");
  RenderSettings settings = whole_image(scene, direct || smooth ? 256 : 64);
  const Image kernels = render(scene, settings).image;
  settings.seed = 77;
  expect_agreement(kernels, reference_image(scene, settings),
                   share_of_significance(shipped_scenes().size()), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Guards, Seeds, ::testing::ValuesIn(shipped_scenes()), test_name);

/// A ball of the BSDF above a floor, lit by a large quad and a dim sky.
Scene ball_scene(const Bsdf& bsdf, const std::string& integrator) {
  Scene scene = make_scene(integrator);
  add_mesh(scene, make_sphere(3, false), bsdf);
  add_mesh(scene, make_quad({-3, -1, -3}, {-3, -1, 3}, {3, -1, 3}, {3, -1, -3}), bsdf);
  add_mesh(scene, make_quad({-2, 3, -2}, {2, 3, -2}, {2, 3, 2}, {-2, 3, 2}), bsdf::Diffuse{},
           Color(2, 3, 4));
  scene.emitters.emplace_back(EnvironmentEmitter{1, 1, {Color(0.5F)}});
  set_camera(scene, 20, 60, {0, 1, -3}, {0, -0.2, 0});
  return scene;
}

// What BSDFs know of sampling is left out: a density that is wrong in both renderers shows.
TEST(Guards, the_uniform_hemisphere_gives_the_same_image) {
  const std::vector<Bsdf> bsdfs{bsdf::Diffuse{Color(0.8F, 0.5F, 0.2F)},
                                bsdf::RoughConductor{Color(0.9F, 0.6F, 0.2F), 0.3F},
                                bsdf::RoughConductor{Color(0.9F, 0.6F, 0.2F), 1.0F},
                                bsdf::RoughSubstrate{Color(0.3F, 0.2F, 0.7F), 0.3F},
                                bsdf::RoughSubstrate{Color(0.3F, 0.2F, 0.7F), 0.8F, 1.0F, 2.4F}};
  const std::vector<std::string> integrators{"direct_mats", "direct_mis", "path_mats"};
  const double share = share_of_significance(bsdfs.size() * integrators.size() * 2);
  for (const Bsdf& bsdf : bsdfs) {
    for (const std::string& integrator : integrators) {
      Scene scene = ball_scene(bsdf, integrator);
      scene.integrator.max_depth = 3;
      RenderSettings uniform = whole_image(scene, 1024);
      uniform.sampling = LobeSampling::uniform;
      uniform.seed = 5;
      const Image expected = reference_image(scene, uniform);
      for (const LobeSampling sampling : {LobeSampling::visible, LobeSampling::ndf}) {
        RenderSettings settings = whole_image(scene, 256);
        settings.sampling = sampling;
        expect_agreement(render(scene, settings).image, expected, share,
                         fmt::format("{}, BSDF of type {}", integrator, bsdf.index()));
      }
    }
  }
}

}  // namespace
}  // namespace facet::test
