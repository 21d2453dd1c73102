// The public face: scenes in memory, requests, errors, films.
#include <facet/facet.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/input.h"
#include "support/render.h"

namespace facet::test {
namespace {

TriangleMesh square(float y) {
  return {.positions = {{-1, y, -1}, {-1, y, 1}, {1, y, 1}, {1, y, -1}},
          .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

/// A grey floor under a constant sky, seen from above.
SceneMaker floor_under_sky() {
  SceneMaker maker;
  maker.integrator({"path_mis"});
  maker.sampler({"independent", {{"sampleCount", 4}, {"seed", 3}}});
  maker.camera({"perspective",
                {{"width", 8},
                 {"height", 6},
                 {"fov", 20.0},
                 {"rfilter", std::vector<Plugin>{{"box"}}},
                 {"toWorld", LookAt{.origin = {0, 3, 0}, .target = {0, 0, 0}, .up = {0, 0, 1}}}}});
  maker.emitter({"environment", {{"radiance", Rgb{1, 2, 4}}}});
  maker.mesh(square(0), {"diffuse", {{"albedo", Rgb{0.5F, 0.25F, 0.125F}}}});
  return maker;
}

/// What an Error says of itself.
template <typename Call>
Error error_of(const Call& call) {
  try {
    (void)call();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error";
  return {ErrorKind::input, ""};
}

TEST(SceneMaker, says_what_a_file_would) {
  const TemporaryFolder folder;
  folder.write("floor.obj", "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3\nf 1 3 4\n");
  const std::filesystem::path file = folder.write("scene.xml", R"(<scene>
<integrator type="path_mis"/>
<sampler type="independent"><integer name="sampleCount" value="4"/>
<integer name="seed" value="3"/></sampler>
<camera type="perspective"><integer name="width" value="8"/><integer name="height" value="6"/>
<float name="fov" value="20"/><rfilter type="box"/>
<transform name="toWorld"><lookat origin="0 3 0" target="0 0 0" up="0 0 1"/></transform></camera>
<emitter type="environment"><color name="radiance" value="1 2 4"/></emitter>
<mesh type="obj"><string name="filename" value="floor.obj"/>
<bsdf type="diffuse"><color name="albedo" value="0.5 0.25 0.125"/></bsdf></mesh>
</scene>)");
  const ScenePtr read = facet::load_scene(file);
  const ScenePtr made = floor_under_sky().scene({.strict = true});
  const SceneSummary summary = summarise(*made);
  EXPECT_EQ(summary.width, 8);
  EXPECT_EQ(summary.samples, 4);
  EXPECT_EQ(summary.triangles, 2U);
  EXPECT_EQ(summary.integrator, "path_mis");
  const auto backend = open_backend({.reference = Precision::float_});
  const Film a = backend->render(read);
  const Film b = backend->render(made);
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_EQ(a.record.fingerprint, b.record.fingerprint);
  EXPECT_EQ(b.record.scene, "");
}

TEST(SceneMaker, a_white_furnace_is_white) {
  // Under a sky of radiance 1 a floor of albedo a sends back a, whatever the direction.
  const auto backend = open_backend({.reference = Precision::double_});
  const Film film = backend->render(floor_under_sky().scene(), {.samples = 4096});
  const std::array<double, 3> expected{0.5, 0.5, 0.5};
  for (std::size_t c = 0; c < 3; ++c) {
    double mean = 0;
    for (const PixelSums& pixel : film.pixels) mean += pixel.mean().at(c);
    mean /= static_cast<double>(film.pixels.size());
    EXPECT_NEAR(mean, expected.at(c), 0.001) << c;
  }
}

TEST(SceneMaker, refuses_what_the_language_does_not_allow) {
  const auto message = [](SceneMaker& maker) {
    return std::string(error_of([&] { return maker.scene(); }).what());
  };
  SceneMaker none;
  EXPECT_NE(message(none).find("no camera"), std::string::npos);
  SceneMaker maker = floor_under_sky();
  maker.mesh(square(1), {"diffus"});
  EXPECT_NE(message(maker).find("did you mean \"diffuse\"?"), std::string::npos) << message(maker);
  SceneMaker rough = floor_under_sky();
  rough.mesh(square(1), {"roughconductor", {{"alpha", 7.0}}});
  EXPECT_NE(message(rough).find("\"alpha\""), std::string::npos) << message(rough);
  SceneMaker corners = floor_under_sky();
  EXPECT_NE(std::string(error_of([&] {
                          return corners.mesh({.positions = {{0, 0, 0}}, .triangles = {{0, 0, 1}}},
                                              {"diffuse"}),
                                 0;
                        }).what())
                .find("has the corner 1, but there are 1 positions"),
            std::string::npos);
  EXPECT_THROW(corners.mesh({.positions = {{0, NAN, 0}}, .triangles = {}}, {"diffuse"}), Error);
  EXPECT_THROW(
      corners.mesh({.positions = {{0, 0, 0}}, .triangles = {}, .normals = {{0, 0, 1}, {0, 0, 1}}},
                   {"diffuse"}),
      Error);
}

TEST(SceneMaker, warns_of_what_nobody_asked_for) {
  SceneMaker maker = floor_under_sky();
  maker.mesh(square(1), {"diffuse", {{"albdo", Rgb{1, 1, 1}}}});
  std::vector<std::string> warnings;
  (void)maker.scene({.on_warning = [&](const std::string& w) { warnings.push_back(w); }});
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("albdo"), std::string::npos);
  EXPECT_THROW((void)maker.scene({.strict = true}), Error);
}

TEST(LoadScene, reads_no_file_outside_the_assets) {
  const TemporaryFolder folder;
  folder.write("floor.obj", "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nf 1 2 3\n");
  std::filesystem::create_directory(folder.file("in"));
  const auto scene = folder.write("in/scene.xml", R"(<scene><camera type="perspective"/>
<mesh type="obj"><string name="filename" value="../floor.obj"/></mesh></scene>)");
  EXPECT_NE(facet::load_scene(scene), nullptr);
  EXPECT_NE(facet::load_scene(scene, {.assets_below = folder.path()}), nullptr);
  const Error error =
      error_of([&] { return facet::load_scene(scene, {.assets_below = folder.file("in")}); });
  EXPECT_EQ(error.where().line, 2);
  EXPECT_NE(std::string(error.what()).find("is not read"), std::string::npos);
}

TEST(Errors, tell_kind_and_place) {
  const TemporaryFolder folder;
  const auto file = folder.write("bad.xml", "<scene>\n<camera type=\"fisheye\"/>\n</scene>");
  const Error error = error_of([&] { return facet::load_scene(file); });
  EXPECT_EQ(error.kind(), ErrorKind::input);
  EXPECT_EQ(error.where().file, file.string());
  EXPECT_EQ(error.where().line, 2);
  const Error device = error_of([] { return open_backend({.device = "no such device"}); });
  EXPECT_EQ(device.kind(), ErrorKind::device);
  EXPECT_EQ(device.where().file, "");
}

class Requests : public ::testing::Test {
 protected:
  [[nodiscard]] Film render(const RenderRequest& request) const {
    return backend_->render(scene_, request);
  }
  [[nodiscard]] Error error(const RenderRequest& request) const {
    return error_of([&] { return render(request); });
  }

  ScenePtr scene_ = floor_under_sky().scene();
  std::unique_ptr<Backend> backend_ = open_backend({.reference = Precision::float_});
};

TEST_F(Requests, leave_the_scene_as_it_is) {
  const Film before = render({});
  const Film other = render({.samples = 2,
                             .integrator = "normals",
                             .sampler = "sobol",
                             .max_depth = 1,
                             .size = ImageSize{4, 4},
                             .seed = 9,
                             .heuristic = Heuristic::power,
                             .masking = Masking::exact});
  EXPECT_EQ(other.width, 4);
  EXPECT_EQ(other.record.integrator, "normals");
  EXPECT_EQ(other.record.samples.text(), "0:2");
  EXPECT_EQ(other.record.seed, 9U);
  EXPECT_EQ(before.record.seed, 3U);
  EXPECT_EQ(before.record.samples.text(), "0:4");
  EXPECT_EQ(render({}).pixels, before.pixels);
}

TEST_F(Requests, that_nothing_can_meet_are_refused) {
  EXPECT_EQ(error({.samples = 0}).kind(), ErrorKind::input);
  EXPECT_NE(std::string(error({.integrator = "path_miss"}).what()).find("path_mis"),
            std::string::npos);
  EXPECT_NE(std::string(error({.sampler = "halton"}).what()).find("independent"),
            std::string::npos);
  EXPECT_EQ(error({.sample_range = SampleRange{4, 4}}).kind(), ErrorKind::input);
  EXPECT_EQ(error({.max_depth = -2}).kind(), ErrorKind::input);
  EXPECT_EQ(error({.size = ImageSize{0, 4}}).kind(), ErrorKind::input);
  EXPECT_EQ(error({.crop = Crop{0, 0, 9, 6}}).kind(), ErrorKind::input);
  EXPECT_EQ(error({.crop = Crop{-1, 0, 2, 2}}).kind(), ErrorKind::input);
  EXPECT_EQ(error({.crop = Crop{0, 0, 1, 1}, .pixel = {{0, 0}}}).kind(), ErrorKind::input);
}

TEST_F(Requests, can_be_watched_and_ended) {
  int calls = 0;
  const Film film =
      render({.samples = 1 << 20, .progress = [&](double done, const RenderStatistics& s) {
                EXPECT_GT(done, 0);
                EXPECT_GT(s.samples, 0U);
                return ++calls < 2;
              }});
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(film.record.stopped_by, StoppedBy::interrupt);
  EXPECT_EQ(render({}).record.stopped_by, StoppedBy::samples);
}

TEST_F(Requests, a_pixel_and_a_crop_are_parts_of_the_whole) {
  const Film whole = render({});
  const Film crop = render({.crop = Crop{2, 1, 5, 4}});
  const Film pixel = render({.pixel = {{3, 2}}});
  EXPECT_EQ(crop.at(1, 1), whole.at(3, 2));
  EXPECT_EQ(pixel.at(0, 0), whole.at(3, 2));
  EXPECT_EQ(pixel.window.x, 3);
  EXPECT_EQ(pixel.window.full_width, 8);
}

TEST_F(Requests, samples_one_by_one_are_the_film) {
  RenderRequest request{.samples = 3};
  const Film whole = render(request);
  const auto rendering = backend_->start(scene_, request);
  std::array<double, 3> sum{};
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::vector<Radiance> radiances = rendering->sample(i);
    ASSERT_EQ(radiances.size(), whole.pixels.size());
    for (std::size_t c = 0; c < 3; ++c) sum.at(c) += static_cast<double>(radiances[11].at(c));
  }
  EXPECT_EQ(rendering->film().pixels, whole.pixels);
  // Under a box filter every weight is 1.
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(sum.at(c), whole.pixels[11].values.at(c), 1e-6 * sum.at(c));
}

TEST_F(Requests, parts_merge_to_the_whole) {
  const TemporaryFolder folder;
  const std::string a = folder.file("a.exr").string();
  const std::string b = folder.file("b.exr").string();
  write_image(a, render({.sample_range = SampleRange{0, 3}}), {.part = true});
  write_image(b, render({.sample_range = SampleRange{3, 4}}), {.part = true});
  const Film merged = merge_parts({b, a});
  const Film whole = render({});
  EXPECT_EQ(merged.record.samples.text(), "0:4");
  for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(merged.pixels[i].values.at(c), whole.pixels[i].values.at(c), 1e-12);
  }
  const ComparisonSummary same = compare(develop(merged, false), develop(whole, false));
  EXPECT_LT(same.rmse, 1e-7);
  EXPECT_NEAR(same.mean_ratio, 1, 1e-6);
  write_image(b, render({.sample_range = SampleRange{3, 4}, .seed = 4}), {.part = true});
  EXPECT_THROW((void)merge_parts({a, b}), Error);
  EXPECT_THROW((void)merge_parts({}), Error);
}

TEST_F(Requests, kernels_have_no_uniform_sampling) {
  EXPECT_THROW(
      (void)kernel_backend().start(scene_, RenderRequest{.sampling = LobeSampling::uniform}),
      Error);
}

}  // namespace
}  // namespace facet::test
