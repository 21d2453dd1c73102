// What can be chosen for which scene, and the options that say so.
#include <gtest/gtest.h>

#include "support/render.h"
#include "support/scenes.h"
#include "tradeoff/choices.h"

namespace facet::tradeoff {

namespace {

using test::add_mesh;
using test::make_mesh;
using test::make_quad;
using Names = std::vector<std::string>;

bsdf::RoughConductor rough() {
  bsdf::RoughConductor bsdf;
  bsdf.alpha = 0.3F;
  return bsdf;
}

/// A rough floor under as many lamps of two triangles.
Scene floor_under(int lamps, const std::string& integrator, const Bsdf& floor = rough()) {
  Scene scene = test::make_scene(integrator);
  test::set_camera(scene, 8, 40, {0, 2, -3}, {0, 0, 0});
  add_mesh(scene, make_quad({-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}), floor);
  for (int i = 0; i < lamps; ++i) {
    const auto x = static_cast<float>(3 * i);
    add_mesh(scene, make_quad({x, 3, 0}, {x + 1, 3, 0}, {x + 1, 3, 1}, {x, 3, 1}), bsdf::Diffuse{},
             Color(1));
  }
  return scene;
}

Names names_around(const Scene& scene, const Plan& plan, bool with_biased = false) {
  Names names;
  for (const Candidate& c : candidates_around(scene, plan, Plan(), with_biased))
    names.push_back(name_of(scene, c.plan, Plan()));
  std::ranges::sort(names);
  return names;
}

TEST(TradeoffChoices, AreWhatTheSceneHasAUseFor) {
  EXPECT_EQ(names_around(floor_under(2, "direct_mis"), {}),
            (Names{"adaptive", "area-sampling solidangle", "direct_ems", "direct_mats",
                   "direct_whitted", "emitter-candidates 4", "emitter-selection power",
                   "emitter-selection uniform", "heuristic power", "sampling ndf", "sobol"}));
  // One lamp of two triangles is sampled as one, and every emitter is sampled anyway.
  EXPECT_EQ(names_around(floor_under(1, "direct_mis"), {}),
            (Names{"adaptive", "area-sampling solidangle", "direct_ems", "direct_mats",
                   "emitter-candidates 4", "heuristic power", "sampling ndf", "sobol"}));
  // Beside a sky it gets half of the samples, or its share of the power.
  Scene under_sky = floor_under(1, "direct_ems");
  under_sky.emitters.emplace_back(EnvironmentEmitter{1, 1, {Color(1)}});
  EXPECT_EQ(names_around(under_sky, {}),
            (Names{"adaptive", "area-sampling solidangle", "direct_mats", "direct_mis",
                   "direct_whitted", "emitter-candidates 4", "emitter-selection power", "sobol"}));
  // Sampling emitters alone, direct light needs no lobe; nothing is weighted.
  EXPECT_EQ(names_around(floor_under(1, "direct_ems"), {}),
            (Names{"adaptive", "area-sampling solidangle", "direct_mats", "direct_mis",
                   "emitter-candidates 4", "sobol"}));
  EXPECT_EQ(names_around(floor_under(1, "path_ems", bsdf::Diffuse{}), {}),
            (Names{"adaptive", "area-sampling solidangle", "emitter-candidates 4", "path",
                   "path_mats", "sobol"}));
  EXPECT_EQ(names_around(floor_under(1, "ao"), {}), (Names{"adaptive", "sobol"}));
  // The error of a pixel is that of sobol, whichever of them the scene takes.
  Scene ordered = floor_under(1, "ao");
  ordered.sampler = Sampler::zsobol;
  EXPECT_EQ(names_around(ordered, {}), (Names{"adaptive", "independent"}));
  // Lamps that fill little of what any point sees are as well sampled by area.
  Scene small = floor_under(1, "path_ems", bsdf::Diffuse{});
  for (vec3& p : small.meshes[std::get<AreaEmitter>(small.emitters[0]).mesh].positions)
    p = 0.02F * p + vec3(0, 1, 0);
  EXPECT_EQ(std::ranges::count(names_around(small, {}), "area-sampling solidangle"), 0);
}

TEST(TradeoffChoices, BiasedOnesAreTold) {
  const auto biased = [](const Scene& scene, const Plan& plan) {
    Names names;
    for (const Candidate& c : candidates_around(scene, plan, Plan(), true)) {
      if (c.biased) names.push_back(name_of(scene, c.plan, Plan()));
    }
    return names;
  };
  EXPECT_EQ(biased(floor_under(1, "path"), {}),
            (Names{"max-depth 2", "max-depth 3", "max-depth 5", "max-depth 8", "masking exact",
                   "backend reference", "backend reference, precision double"}));
  Plan limited;
  limited.request.max_depth = 5;
  EXPECT_EQ(biased(floor_under(1, "path", bsdf::Diffuse{}), limited),
            (Names{"max-depth 2", "max-depth 3", "backend reference, max-depth 5",
                   "backend reference, precision double, max-depth 5"}));
  bsdf::RoughConductor ggx = rough();
  ggx.options.distribution = bsdf::Distribution::ggx;
  EXPECT_EQ(biased(floor_under(1, "direct_mis", ggx), {}),
            (Names{"backend reference", "backend reference, precision double"}));
}

TEST(TradeoffChoices, WhatMeansNothingAnyMoreIsAsInTheBase) {
  const Scene scene = floor_under(2, "direct_mis");
  Plan plan;
  plan.request.heuristic = Heuristic::power;
  plan.request.emitter_selection = EmitterSelection::uniform;
  for (const Candidate& c : candidates_around(scene, plan, Plan(), false)) {
    const std::string name = c.plan.request.integrator.value_or("");
    if (name == "direct_ems") {
      EXPECT_EQ(c.options, (Names{"--integrator", name, "--emitter-selection", "uniform"}));
    } else if (name == "direct_mats") {
      EXPECT_EQ(c.options, (Names{"--integrator", name}));
    }
  }
}

TEST(TradeoffChoices, CombineToWhatTheyMeanTogether) {
  const Scene scene = floor_under(2, "direct_mis");
  std::vector<Candidate> chosen;
  for (Candidate& c : candidates_around(scene, {}, {}, false)) {
    const std::string name = name_of(scene, c.plan, {});
    if (name == "direct_mats" || name == "heuristic power" || name == "sobol")
      chosen.push_back(std::move(c));
  }
  ASSERT_EQ(chosen.size(), 3U);
  std::ranges::reverse(chosen);
  const Plan together = combine(scene, {}, chosen);
  EXPECT_EQ(options_of(scene, together),
            (Names{"--integrator", "direct_mats", "--sampler", "sobol"}));
  EXPECT_EQ(name_of(scene, together, {}), "direct_mats, sobol");
}

TEST(TradeoffChoices, OptionsSayWhatTheSceneDoesNot) {
  const Scene scene = floor_under(1, "path");
  Plan plan;
  EXPECT_EQ(options_of(scene, plan), Names{});
  EXPECT_EQ(name_of(scene, plan, plan), "default");
  plan.request.adaptive = true;
  plan.request.max_depth = 4;
  plan.request.masking = Masking::exact;
  plan.reference = Precision::double_;
  EXPECT_EQ(options_of(scene, plan),
            (Names{"--backend", "reference", "--precision", "double", "--max-depth", "4",
                   "--masking", "exact", "--adaptive"}));
  Plan even = plan;
  even.request.adaptive = false;
  EXPECT_EQ(name_of(scene, even, plan), "not adaptive");
  // A scene without an integrator gets it from whoever asks.
  Scene open = scene;
  open.integrator = {};
  Plan asked;
  asked.request.integrator = "path_mis";
  EXPECT_EQ(options_of(open, asked), (Names{"--integrator", "path_mis"}));
}

TEST(TradeoffChoices, AnIntegratorHasOneName) {
  const Scene scene = floor_under(1, "path_mis");
  Plan emitters;
  emitters.request.integrator = "path_ems";
  Names names;
  for (const Candidate& c : candidates_around(scene, emitters, {}, false)) {
    if (c.kind == "integrator") names.push_back(name_of(scene, c.plan, {}));
  }
  EXPECT_EQ(names, (Names{"default", "path_mats"})) << "path is path_mis, which the scene says";
}

TEST(TradeoffChoices, ASeedIsNoChoice) {
  const Scene scene = floor_under(1, "path");
  Plan plan;
  plan.request.seed = 7;
  EXPECT_EQ(options_of(scene, plan), Names{});
}

TEST(TradeoffChoices, OnlyAMapHasSomethingAboveItsMean) {
  Scene scene = floor_under(1, "direct_mis");
  scene.emitters.emplace_back(EnvironmentEmitter{1, 1, {Color(1)}});
  const auto has = [&] {
    const Names names = names_around(scene, {});
    return std::ranges::find(names, "environment-sampling radiance") != names.end();
  };
  EXPECT_FALSE(has());
  scene.emitters.back() = EnvironmentEmitter{2, 1, {Color(1), Color(3)}};
  EXPECT_TRUE(has());
}

TEST(TradeoffChoices, ReferencesUseBothEstimatorsAndNoBias) {
  const Scene scene = floor_under(1, "direct_mats");
  Plan plan;
  plan.request.adaptive = true;
  plan.reference = Precision::float_;
  const Plan reference = reference_plan(scene, plan);
  EXPECT_EQ(reference.request.integrator, "direct_mis");
  EXPECT_EQ(reference.request.sampler, "sobol");
  EXPECT_FALSE(reference.request.adaptive);
  EXPECT_FALSE(reference.reference);
  // Of what estimates no light there is one integrator.
  EXPECT_EQ(reference_plan(floor_under(1, "normals"), {}).request.integrator, std::nullopt);
}

}  // namespace

}  // namespace facet::tradeoff
