// Every shipped scene and every integrator: the kernels' samples are the reference's, or differ for
// a reason.
#include "support/parity.h"

#include "support/bsdf_cases.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

void shrink(Scene& scene, int width) {
  scene.camera.height = std::max(1, scene.camera.height * width / scene.camera.width);
  scene.camera.width = width;
}

class ShippedScene : public ::testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, holds_under_both_lobe_samplings) {
  Scene scene = load_scene(GetParam());
  shrink(scene, 60);
  RenderSettings settings = whole_image(scene, 4);
  expect_parity(scene, settings);
  if (!samples_half_vectors(scene)) return;
  settings.sampling = LobeSampling::ndf;
  expect_parity(scene, settings);
}

INSTANTIATE_TEST_SUITE_P(Parity, ShippedScene, ::testing::ValuesIn(shipped_scenes()), test_name);

class EachIntegrator : public ::testing::TestWithParam<std::string> {};

TEST_P(EachIntegrator, holds_under_area_lights_and_under_a_sky) {
  for (const char* name : {"cbox/cbox_substrate_mis.xml", "serapis/serapis_rough_mis.xml"}) {
    Scene scene = load_scene(name);
    shrink(scene, 60);
    set_integrator(scene, GetParam());
    // The light of `simple` by default lies in a corner of the box, where whatever it lights hides
    // it or not by rounding.
    scene.integrator.position = vec3(dvec3(scene.camera.to_world * glm::dvec4(0.3, 0.5, 0.2, 1)));
    expect_parity(scene, whole_image(scene, 4));
  }
}

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const IntegratorType& type : integrator_types()) names.emplace_back(type.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Parity, EachIntegrator, ::testing::ValuesIn(integrator_names()),
                         test_name);

/// Three balls under two lights of unequal power and a constant sky.
Scene scene_of_balls(const std::array<Bsdf, 3>& bsdfs) {
  Scene scene = make_scene("path_mis");
  for (std::size_t i = 0; i < bsdfs.size(); ++i) {
    Mesh ball = make_sphere(3, false);
    transform(ball, 0.4F, {static_cast<float>(i) - 1, -0.2F, 0.3F});
    add_mesh(scene, ball, bsdfs[i]);
  }
  add_mesh(scene, make_quad({-2, -0.6F, -2}, {-2, -0.6F, 2}, {2, -0.6F, 2}, {2, -0.6F, -2}),
           bsdf::Diffuse{});
  add_mesh(scene, make_quad({-1.5F, 1, -0.3F}, {-1, 1, -0.3F}, {-1, 1, 0.3F}, {-1.5F, 1, 0.3F}),
           bsdf::Diffuse{}, Color(8, 4, 4));
  add_mesh(scene, make_quad({1, 0.8F, -0.3F}, {1.2F, 0.8F, -0.3F}, {1.2F, 0.8F, 0}, {1, 0.8F, 0}),
           bsdf::Diffuse{}, Color(2, 4, 30));
  scene.emitters.emplace_back(EnvironmentEmitter{1, 1, {Color(0.2F, 0.3F, 0.4F)}});
  set_camera(scene, 48, 70, {0, 0.3, -2}, {0, -0.2, 0.5});
  return scene;
}

Scene busy_scene() {
  return scene_of_balls({bsdf::RoughConductor{Color(0.9F, 0.6F, 0.2F), 0.05F},
                         bsdf::RoughSubstrate{Color(0.3F, 0.2F, 0.7F), 0.2F},
                         bsdf::Diffuse{Color(0.5F, 0.7F, 0.3F)}});
}

class EachBsdf : public ::testing::TestWithParam<std::size_t> {};

TEST_P(EachBsdf, holds_for_some_of_its_parameters) {
  // From the middle of the roughnesses: at both ends few samples find the light.
  const std::vector<BsdfCase> cases = bsdf_cases(GetParam());
  const auto at = [&](std::size_t i) { return cases[(3 + i) % cases.size()].bsdf; };
  const Scene scene = scene_of_balls({at(0), at(1), at(cases.size() / 4)});
  expect_parity(scene, whole_image(scene, 4));
}

INSTANTIATE_TEST_SUITE_P(Parity, EachBsdf, testing::Range<std::size_t>(0, bsdf_type_names.size()),
                         [](const auto& tested) {
                           return std::string(bsdf_type_names[tested.param]);
                         });

TEST(Parity, holds_for_every_choice_of_the_estimator) {
  Scene scene = busy_scene();
  for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
    for (const EmitterSelection selection :
         {EmitterSelection::contribution, EmitterSelection::power, EmitterSelection::uniform}) {
      scene.integrator.heuristic = heuristic;
      RenderSettings settings = whole_image(scene, 4);
      settings.integrator.emitter_selection = selection;
      expect_parity(scene, settings);
    }
  }
  for (const int candidates : {2, 3, 16}) {
    RenderSettings settings = whole_image(scene, 4);
    settings.integrator.emitter_candidates = candidates;
    expect_parity(scene, settings);
  }
  RenderSettings by_radiance = whole_image(scene, 4);
  by_radiance.integrator.environment_sampling = EnvironmentSampling::radiance;
  expect_parity(scene, by_radiance);
  for (const int depth : {0, 1, 2, 7}) {
    scene.integrator.max_depth = depth;
    expect_parity(scene, whole_image(scene, 4));
  }
}

TEST(Parity, holds_for_every_filter) {
  Scene scene = busy_scene();
  for (const Filter& filter : {Filter(GaussianFilter{}), Filter(MitchellFilter{}),
                               Filter(TentFilter{}), Filter(BoxFilter{})}) {
    scene.camera.filter = filter;
    expect_parity(scene, whole_image(scene, 4));
  }
}

TEST(Parity, holds_for_crops_seeds_and_later_samples) {
  const Scene scene = busy_scene();
  RenderSettings settings = whole_image(scene, 4);
  settings.crop = {5, 9, 41, 30};
  settings.seed = 4000000000U;
  settings.samples.begin = 1000003;
  settings.samples.end = 1000007;
  expect_parity(scene, settings);
}

TEST(Parity, holds_for_ordered_samplers) {
  Scene scene = busy_scene();
  for (const Sampler sampler : {Sampler::sobol, Sampler::zsobol}) {
    scene.sampler = sampler;
    for (const char* integrator : {"path_mis", "whitted"}) {
      set_integrator(scene, integrator);
      RenderSettings settings = whole_image(scene, 4);
      settings.seed = 4000000000U;
      settings.planned = 3;
      expect_parity(scene, settings);
    }
  }
}

TEST(Parity, holds_for_points_by_solid_angle) {
  Scene scene = busy_scene();
  // Close above all of it, so that it fills much of what any point sees.
  add_mesh(scene, make_quad({-3, 3, -3}, {3, 3, -3}, {3, 3.5F, 3}, {-3, 3.5F, 3}),
           bsdf::Diffuse{Color(0.1F)}, Color(0.5F));
  scene.integrator.area_sampling = AreaSampling::solid_angle;
  for (const char* integrator : {"path_mis", "whitted"}) {
    for (const EmitterSelection selection :
         {EmitterSelection::contribution, EmitterSelection::power}) {
      set_integrator(scene, integrator);
      scene.integrator.emitter_selection = selection;
      expect_parity(scene, whole_image(scene, 4));
    }
  }
}

std::uint64_t count_nonzero(const Film& film) {
  std::uint64_t count = 0;
  for (const PixelSums& pixel : film.pixels) count += pixel.nonzero;
  return count;
}

// The end of a shadow ray lies off the emitter by more than the test against the emitter errs from
// afar; the reference in double hardly errs.
TEST(Parity, lights_do_not_shadow_themselves_from_afar) {
  Scene scene = make_scene("direct_ems");
  Mesh light = make_sphere(3, false);
  transform(light, 0.5F, {0, 0, 0});
  add_mesh(scene, light, bsdf::Diffuse{}, Color(1));
  add_mesh(scene, make_quad({-60, -40, -60}, {-60, -40, 60}, {60, -40, 60}, {60, -40, -60}),
           bsdf::Diffuse{});
  set_camera(scene, 64, 60, {0, 10, -80}, {0, -40, 0});
  const RenderSettings settings = whole_image(scene, 16);
  const Film exact = render_reference(scene, settings, Precision::double_);
  EXPECT_GT(count_nonzero(exact), 10000U);
  EXPECT_EQ(count_nonzero(render(scene, settings).film), count_nonzero(exact));
}

}  // namespace
}  // namespace facet::test
