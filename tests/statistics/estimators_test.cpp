// Estimators of the same light agree, cell by cell.
#include "compare/z_test.h"
#include "core/words.h"
#include "support/render.h"
#include "support/scenes.h"

namespace facet::test {
namespace {

/// Of one of the 50 comparisons of this file.
constexpr double significance = 0.01 / 50;

/// Shrinks the image, keeping its shape.
void shrink(Scene& scene, int width) {
  scene.camera.height = std::max(1, scene.camera.height * width / scene.camera.width);
  scene.camera.width = width;
}

Image estimate(Scene scene, const std::string& integrator, std::uint32_t seed, int spp,
               LobeSampling sampling = LobeSampling::visible,
               EmitterSelection selection = EmitterSelection::contribution) {
  set_integrator(scene, integrator);
  scene.seed = seed;
  RenderSettings settings = whole_image(scene, spp);
  settings.sampling = sampling;
  settings.integrator.emitter_selection = selection;
  return render(scene, settings).image;
}

void expect_agreement(const Image& a, const Image& b, const std::string& what) {
  test::expect_agreement(a, b, significance, what);
}

/// Samples with which every cell holds enough contributions of the rarest kind.
int samples_for(const std::string& scene) { return scene.starts_with("veach") ? 2048 : 512; }

/// BSDF samples find the small sun of that sky once in thousands, and the rest of the sky hides
/// from the test of means how few those are, most of all in pixels that see the sky. Here each
/// block of texels has its mean, a sun that is found often enough, and the camera sees the bust
/// alone.
void widen_sun(Scene& scene) {
  constexpr int block = 16;
  for (Emitter& emitter : scene.emitters) {
    auto* sky = std::get_if<EnvironmentEmitter>(&emitter);
    if (sky == nullptr) continue;
    EnvironmentEmitter wide{sky->width / block, sky->height / block, {}};
    wide.texels.resize(static_cast<std::size_t>(wide.width) * static_cast<std::size_t>(wide.height),
                       Color(0));
    for (int y = 0; y < wide.height * block; ++y) {
      for (int x = 0; x < wide.width * block; ++x)
        wide.texels[static_cast<std::size_t>(y / block * wide.width + x / block)] +=
            sky->texels[static_cast<std::size_t>(y * sky->width + x)] /
            static_cast<float>(block * block);
    }
    *sky = wide;
    scene.camera.fov = 6;
  }
}

/// Fewer pixels of more samples each, at the same cost, where bright samples are rare: an emitter
/// sample meets the peak of Veach's smoothest plate once in 40,000.
int concentration_of(const std::string& scene) {
  if (scene.starts_with("veach")) return 8;
  return scene.starts_with("serapis") ? 4 : 1;
}

class Estimators : public testing::TestWithParam<const char*> {};

TEST_P(Estimators, of_direct_light_agree) {
  Scene scene = load_scene(GetParam());
  const int concentration = concentration_of(GetParam());
  widen_sun(scene);
  shrink(scene, 48 / concentration);
  const int spp = samples_for(GetParam()) * concentration * concentration;
  const Image ems = estimate(scene, "direct_ems", 1, spp);
  const Image mats = estimate(scene, "direct_mats", 2, spp);
  const Image mis = estimate(scene, "direct_mis", 3, spp);
  expect_agreement(ems, mats, "ems, mats");
  expect_agreement(ems, mis, "ems, mis");
  expect_agreement(mats, mis, "mats, mis");
  const Image ndf = estimate(scene, "direct_mis", 4, spp / 2, LobeSampling::ndf);
  expect_agreement(mis, ndf, "visible, ndf");
}

TEST_P(Estimators, of_all_light_agree) {
  Scene scene = load_scene(GetParam());
  scene.integrator.max_depth = -1;
  const int concentration = concentration_of(GetParam());
  widen_sun(scene);
  shrink(scene, 32 / concentration);
  const int spp = 512 * concentration * concentration;
  const Image ems = estimate(scene, "path_ems", 1, spp);
  const Image mats = estimate(scene, "path_mats", 2, spp);
  const Image mis = estimate(scene, "path_mis", 3, spp);
  expect_agreement(ems, mats, "ems, mats");
  expect_agreement(ems, mis, "ems, mis");
  expect_agreement(mats, mis, "mats, mis");
}

INSTANTIATE_TEST_SUITE_P(Shipped, Estimators,
                         testing::Values("cbox/cbox_conductors_mis.xml",
                                         "cbox/cbox_substrate_mis.xml", "veach_mi/veach_mi_mis.xml",
                                         "serapis/serapis_rough_mis.xml",
                                         "serapis/serapis_smooth_mis.xml"));

TEST(EstimatorChoices, emitter_selection_and_heuristic_keep_the_expectation) {
  Scene scene = load_scene("veach_mi/veach_mi_mis.xml");
  shrink(scene, 48);
  const Image usual = estimate(scene, "direct_mis", 1, 1024);
  const auto uniform = [&scene](std::uint32_t seed) {
    return estimate(scene, "direct_mis", seed, 1024, LobeSampling::visible,
                    EmitterSelection::uniform);
  };
  expect_agreement(usual, uniform(2), "power, uniform selection");
  scene.integrator.heuristic = Heuristic::power;
  expect_agreement(usual, uniform(3), "balance, power heuristic");
}

/// A floor under a lamp and a sky with a sun.
void add_floor_lamp_and_sky(Scene& scene, float roughness, float height, const Color& sun) {
  add_mesh(scene, make_quad({-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}),
           bsdf::RoughSubstrate{Color(0.4F), roughness});
  add_mesh(scene, make_quad({0, height, 0}, {1, height, 0}, {1, height, 1}, {0, height, 1}),
           bsdf::Diffuse{}, Color(3, 2, 1));
  EnvironmentEmitter sky{8, 4, std::vector<Color>(32, Color(0.1F))};
  sky.texels[8 * 2 + 3] = sun;
  scene.emitters.emplace_back(sky);
}

TEST(EstimatorChoices, area_emitter_and_environment_together) {
  Scene scene = make_scene("direct_ems");
  add_floor_lamp_and_sky(scene, 0.2F, 1, Color(9, 8, 7));
  set_camera(scene, 24, 40, {-2, 2, -2}, {0, 0, 0});
  const Image ems = estimate(scene, "direct_ems", 1, 2048);
  expect_agreement(ems, estimate(scene, "direct_mats", 2, 2048), "ems, mats");
  expect_agreement(ems, estimate(scene, "direct_mis", 3, 2048), "ems, mis");
  scene.integrator.environment_sampling = EnvironmentSampling::radiance;
  expect_agreement(ems, estimate(scene, "direct_mis", 4, 2048), "ems, mis by radiance");
}

TEST(EstimatorChoices, one_of_several_candidates_keeps_the_expectation) {
  Scene scene = make_scene("path_mis");
  scene.integrator.max_depth = 3;
  add_floor_lamp_and_sky(scene, 0.2F, 1, Color(9, 8, 7));
  scene.emitters.emplace_back(PointLight{{-1, 1.5F, -1}, Color(0.7F)});
  set_camera(scene, 24, 40, {-2, 2, -2}, {0, 0, 0});
  const Image one = estimate(scene, "path_mis", 1, 1024);
  const auto expect_the_same = [&](const std::string& integrator, int count) {
    scene.integrator.emitter_candidates = count;
    expect_agreement(one, estimate(scene, integrator, 2, 1024),
                     fmt::format("{}, {} candidates", integrator, count));
  };
  expect_the_same("path_mis", 2);
  expect_the_same("path_mis", 16);
  expect_the_same("path_ems", 5);
}

/// A floor close below a lamp of two triangles that it sees as unlike large, and of one alone.
Scene floor_under_large_lamps(const char* integrator) {
  Scene scene = make_scene(integrator);
  scene.integrator.max_depth = 3;
  add_mesh(scene, make_quad({-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}),
           bsdf::RoughSubstrate{Color(0.4F), 0.3F});
  add_mesh(scene, make_quad({-1, 0.1F, -1}, {1, 0.4F, -1}, {1, 0.9F, 1}, {-1, 0.6F, 1}),
           bsdf::Diffuse{}, Color(3, 2, 1));
  add_mesh(scene, make_mesh({{-1.8F, 0.05F, -1}, {-1.2F, 0.3F, 1}, {-1.8F, 0.8F, 1.5F}}),
           bsdf::Diffuse{}, Color(1, 2, 3));
  set_camera(scene, 24, 40, {-2, 2, -2}, {0, 0, 0});
  return scene;
}

TEST(EstimatorChoices, points_by_solid_angle_keep_the_expectation) {
  for (const char* integrator : {"path_mis", "path_ems"}) {
    Scene scene = floor_under_large_lamps(integrator);
    for (const EmitterSelection selection :
         {EmitterSelection::contribution, EmitterSelection::power}) {
      scene.integrator.area_sampling = AreaSampling::area;
      const Image area = estimate(scene, integrator, 1, 1024, LobeSampling::visible, selection);
      scene.integrator.area_sampling = AreaSampling::solid_angle;
      expect_agreement(area, estimate(scene, integrator, 2, 1024, LobeSampling::visible, selection),
                       fmt::format("{}, by solid angle", integrator));
    }
  }
}

/// The mean over pixels of the squared difference of two estimates with different seeds.
double noise_of(const Scene& scene, EnvironmentSampling sampling) {
  Scene changed = scene;
  changed.integrator.environment_sampling = sampling;
  const Image a = estimate(changed, "direct_mis", 1, 64);
  const Image b = estimate(changed, "direct_mis", 2, 64);
  double sum = 0;
  for (int i = 0; i < a.width() * a.height(); ++i)
    sum += std::pow(static_cast<double>(a.plane(1)[i]) - static_cast<double>(b.plane(1)[i]), 2);
  return sum;
}

TEST(EstimatorChoices, what_bsdfs_find_need_not_be_sampled_again) {
  // Under a sky that is half bright, sampling the rest of it serves nothing but MIS.
  Scene scene = make_scene("direct_mis");
  add_mesh(scene, make_quad({-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}), bsdf::Diffuse{});
  EnvironmentEmitter sky{16, 8, std::vector<Color>(128, Color(0.5F))};
  for (std::size_t i = 96; i < 128; ++i) sky.texels[i] = Color(5);
  scene.emitters.emplace_back(sky);
  set_camera(scene, 24, 40, {0, 3, 0.1}, {0, 0, 0});
  // Measured: 2.75 times. Over 576 pixels the ratio of two noises has a deviation of some 8 %.
  const double radiance = noise_of(scene, EnvironmentSampling::radiance);
  const double compensated = noise_of(scene, EnvironmentSampling::compensated);
  EXPECT_GT(radiance, 2 * compensated) << radiance / compensated;
}

// With a surface that is lit from both sides, and whatever can emit.
TEST(EstimatorChoices, all_kinds_of_emitters_by_what_they_contribute) {
  Scene scene = make_scene("path_mis");
  scene.integrator.max_depth = 3;
  add_floor_lamp_and_sky(scene, 0.3F, 1.5F, Color(3));
  Mesh pane = make_sphere(2, false);
  transform(pane, 0.5F, {-0.5F, 0.7F, 0});
  add_mesh(scene, pane, bsdf::RoughDielectric{Color(0.9F), 0.4F});
  Mesh lamp = make_sphere(2, false);
  transform(lamp, 0.2F, {1, 0.6F, 0.5F});
  add_mesh(scene, lamp, bsdf::Diffuse{}, Color(6, 5, 4));
  scene.emitters.emplace_back(PointLight{{-1, 1.5F, -1}, Color(0.7F)});
  set_camera(scene, 24, 50, {-2, 2, -2}, {0, 0.3, 0});
  const Image mis = estimate(scene, "path_mis", 1, 1024);
  expect_agreement(mis, estimate(scene, "path_ems", 2, 1024), "mis, ems");
  for (const EmitterSelection selection : {EmitterSelection::power, EmitterSelection::uniform})
    expect_agreement(mis, estimate(scene, "path_mis", 3, 1024, LobeSampling::visible, selection),
                     "contribution, " + word_of(emitter_selection_words, selection));
}

/// The test itself: it must see a difference of a few standard errors in many pixels together, and
/// one of two pixels.
TEST(EstimatorChoices, a_dimmer_light_is_seen) {
  Scene scene = load_scene("cbox/cbox_conductors_mis.xml");
  shrink(scene, 48);
  const Image usual = estimate(scene, "direct_mis", 1, 512);
  for (Emitter& e : scene.emitters) std::get<AreaEmitter>(e).radiance.value *= 0.99F;
  const Image dimmer = estimate(scene, "direct_mis", 2, 512);
  std::string description;
  EXPECT_FALSE(agree(usual, dimmer, significance, description)) << description;
  EXPECT_TRUE(z_test(usual, dimmer, significance).passed()) << "no need of large cells";

  Image spotted = usual;
  const int pixel = 20 * usual.width() + 24;
  for (int c = 0; c < 3; ++c) {
    spotted.plane(c)[pixel] *= 1.5F;
    spotted.plane(c)[pixel + 1] *= 1.5F;
  }
  EXPECT_FALSE(agree(usual, spotted, significance, description)) << description;
}

}  // namespace
}  // namespace facet::test
