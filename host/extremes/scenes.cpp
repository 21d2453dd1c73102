// Whole renders at the edges: sizes, places and radiances of scenes, shapes of images, fields of
// view, many samples, long paths.
#include <facet/facet.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "extremes/bench.h"

namespace facet::extremes {

namespace {

constexpr double not_finite = std::numeric_limits<double>::infinity();

TriangleMesh quad(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  return {.positions = {a, b, c, d}, .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

/// What is varied of a scene of some two units.
struct Variation {
  float scale = 1;
  Vector3 offset{};
  float radiance = 10;
};

Vector3 placed(const Vector3& p, const Variation& v) {
  Vector3 result{};
  for (std::size_t i = 0; i < 3; ++i) result.at(i) = v.scale * (p.at(i) + v.offset.at(i));
  return result;
}

TriangleMesh placed(TriangleMesh mesh, const Variation& v) {
  for (Vector3& p : mesh.positions) p = placed(p, v);
  return mesh;
}

Rgb gray(float x) { return {x, x, x}; }

/// A metal pyramid on a floor under a lamp.
ScenePtr pyramid(const Variation& v) {
  const TriangleMesh body{.positions = {{-0.5F, 0, -0.5F},
                                        {0.5F, 0, -0.5F},
                                        {0.5F, 0, 0.5F},
                                        {-0.5F, 0, 0.5F},
                                        {0, 0.625F, 0}},
                          .triangles = {{1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}}};
  SceneMaker maker;
  maker.integrator({"path_mis", {{"maxDepth", 4}}});
  maker.sampler({"sobol", {{"sampleCount", 16}}});
  maker.camera({"perspective",
                {{"width", 32},
                 {"height", 24},
                 {"fov", 40.0},
                 {"nearClip", 1e-9},
                 {"farClip", 1e12},
                 {"toWorld", LookAt{.origin = placed({1, 1.25F, -2}, v),
                                    .target = placed({0, 0.125F, 0}, v)}}}});
  maker.mesh(placed(quad({-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}), v),
             {"diffuse", {{"albedo", gray(0.5F)}}});
  maker.mesh(placed(body, v), {"roughconductor", {{"alpha", 0.2}}});
  maker.mesh(
      placed(quad({-0.5F, 2, -0.5F}, {0.5F, 2, -0.5F}, {0.5F, 2, 0.5F}, {-0.5F, 2, 0.5F}), v),
      {"diffuse"}, {"area", {{"radiance", gray(v.radiance)}}});
  return maker.scene();
}

/// Nothing but an even sky.
ScenePtr sky(float radiance, int width, int height, double fov) {
  SceneMaker maker;
  maker.integrator({"path_mis"});
  maker.sampler({"independent", {{"sampleCount", 1}}});
  maker.camera({"perspective", {{"width", width}, {"height", height}, {"fov", fov}}});
  maker.emitter({"environment", {{"radiance", gray(radiance)}}});
  return maker.scene();
}

Image rendered(Bench& bench, const ScenePtr& scene, const RenderRequest& request = {}) {
  const std::unique_ptr<Rendering> rendering = bench.backend().start(scene, request);
  rendering->run([&](double done, const RenderStatistics& /*statistics*/) {
    bench.tell(done);
    return true;
  });
  return develop(rendering->film(), request.variance);
}

/// Calls body(a, b) for the values of two images of one size.
template <typename Body>
void for_each_value(const Image& a, const Image& b, const Body& body) {
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      for (int c = 0; c < 3; ++c)
        body(static_cast<double>(a.at(x, y, c)), static_cast<double>(b.at(x, y, c)));
    }
  }
}

/// Root of the mean squared error over the mean square.
double relative_rmse(const Image& image, const Image& right) {
  double error = 0;
  double size = 0;
  for_each_value(image, right, [&](double a, double b) {
    error += (a - b) * (a - b);
    size += b * b;
  });
  return std::sqrt(error / size);
}

Check base_check(const char* name, const char* range, const char* unit, double limit) {
  return make_check("scenes and images", name, range, unit, limit);
}

Check radiance_check() {
  Check check = base_check("radiance", "lamps from 1e-20 to 1e20, against one of 1 times that",
                           "relative error of a pixel", 1e-5);
  check.measure = [](Bench& bench) {
    Finding finding;
    const Image one = rendered(bench, pyramid({.radiance = 1}));
    for (int e = -20; e <= 20; e += 5) {
      const auto radiance = static_cast<float>(std::pow(10.0, e));
      const Image image = rendered(bench, pyramid({.radiance = radiance}));
      double worst = 0;
      for_each_value(image, one, [&](double a, double b) {
        const double right = b * static_cast<double>(radiance);
        const double error = std::abs(a - right) / std::max(right, 1e-30);
        worst = error <= worst ? worst : error;
      });
      finding.add(worst, [&] { return fmt::format("radiance 1e{}", e); });
    }
    return finding;
  };
  return check;
}

/// Powers of two change no bit of any mantissa: where the image changes, a constant of the code has
/// a size of its own.
Check size_check() {
  Check check = base_check("size of the scene", "times 2^-20 to 2^20, against the scene itself",
                           "values that differ in any bit", 0);
  check.measure = [](Bench& bench) {
    Finding finding;
    const Image one = rendered(bench, pyramid({}));
    for (int e = -20; e <= 20; e += 5) {
      const Image image = rendered(bench, pyramid({.scale = std::ldexp(1.0F, e)}));
      double different = 0;
      for_each_value(image, one, [&](double a, double b) { different += a == b ? 0 : 1; });
      finding.add(different, [&] { return fmt::format("2^{}", e); });
    }
    return finding;
  };
  return check;
}

Check place_check(float distance, double limit, const char* argued) {
  Check check = base_check("", "the scene moved along (1, 0.7, -0.4), against itself at the origin",
                           "relative RMSE, at equal random numbers", limit);
  check.name = fmt::format("{:g} sizes from the origin", distance / 2);
  check.argued = argued;
  check.measure = [distance](Bench& bench) {
    Finding finding;
    const Vector3 offset{distance, 0.7F * distance, -0.4F * distance};
    finding.add(
        relative_rmse(rendered(bench, pyramid({.offset = offset})), rendered(bench, pyramid({}))),
        [&] { return fmt::format("at ({:g}, {:g}, {:g})", offset[0], offset[1], offset[2]); });
    return finding;
  };
  return check;
}

struct Frame {
  int width;
  int height;
  double fov;
};

Check frame_check(const char* name, const char* range, std::vector<Frame> frames) {
  Check check = base_check(name, range, "relative error of a pixel", 1e-6);
  check.measure = [frames = std::move(frames)](Bench& bench) {
    Finding finding;
    constexpr float radiance = 0.7F;
    for (const Frame& f : frames) {
      const Image image = rendered(bench, sky(radiance, f.width, f.height, f.fov));
      double worst = image.width() == f.width && image.height() == f.height ? 0 : not_finite;
      for_each_value(image, image, [&](double a, double /*b*/) {
        const double error = std::abs(a / static_cast<double>(radiance) - 1);
        worst = error <= worst ? worst : error;
      });
      finding.add(worst,
                  [&] { return fmt::format("{} x {}, {} degrees", f.width, f.height, f.fov); });
    }
    return finding;
  };
  return check;
}

Check samples_check() {
  Check check = base_check("samples of a pixel", "2^24 (2^20 where quick) of an even sky",
                           "relative error", 1e-6);
  check.measure = [](Bench& bench) {
    constexpr float radiance = 0.1F;
    RenderRequest request;
    request.samples = bench.quick() ? 1 << 20 : 1 << 24;
    const Image image = rendered(bench, sky(radiance, 1, 1, 30), request);
    Finding finding;
    finding.add(std::abs(image.at(0, 0, 0) / static_cast<double>(radiance) - 1),
                [&] { return fmt::format("{} samples", *request.samples); });
    return finding;
  };
  return check;
}

/// A closed room all of whose walls emit 1 and reflect `albedo`: what is seen is the sum of that
/// series up to the largest depth.
Check depth_check() {
  Check check =
      base_check("depth of paths", "1000 in a closed room of albedo 0.99 whose walls emit",
                 "standard errors of the mean", 4.5);
  check.measure = [](Bench& bench) {
    constexpr float albedo = 0.99F;
    constexpr int depth = 1000;
    SceneMaker maker;
    maker.integrator({"path_mats", {{"maxDepth", depth}}});
    maker.sampler({"independent", {{"sampleCount", 64}}});
    maker.camera({"perspective",
                  {{"width", 16},
                   {"height", 16},
                   {"fov", 90.0},
                   {"toWorld", LookAt{.origin = {0, 0, -0.5F}, .target = {0, 0.1F, 1}}}}});
    const TriangleMesh room{.positions = {{-1, -1, -1},
                                          {1, -1, -1},
                                          {1, 1, -1},
                                          {-1, 1, -1},
                                          {-1, -1, 1},
                                          {1, -1, 1},
                                          {1, 1, 1},
                                          {-1, 1, 1}},
                            .triangles = {{0, 1, 2},
                                          {0, 2, 3},
                                          {5, 4, 7},
                                          {5, 7, 6},
                                          {4, 0, 3},
                                          {4, 3, 7},
                                          {1, 5, 6},
                                          {1, 6, 2},
                                          {3, 2, 6},
                                          {3, 6, 7},
                                          {4, 5, 1},
                                          {4, 1, 0}}};
    maker.mesh(room, {"diffuse", {{"albedo", gray(albedo)}}}, {"area", {{"radiance", gray(1)}}});
    RenderRequest request;
    request.variance = true;
    const Image image = rendered(bench, maker.scene(), request);
    const int variance = image.find_channel("variance.R");
    double sum = 0;
    double error = 0;
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        sum += image.at(x, y, 0);
        error += image.at(x, y, variance);
      }
    }
    const double right =
        (1 - std::pow(static_cast<double>(albedo), depth)) / (1 - static_cast<double>(albedo));
    Finding finding;
    finding.add(std::abs(sum - 256 * right) / std::sqrt(error),
                [&] { return fmt::format("{:.6g}, where {:.6g} is right", sum / 256, right); });
    return finding;
  };
  return check;
}

}  // namespace

std::vector<Check> scene_checks() {
  constexpr const char* few_bits =
      "A float has 24 bits: so far away, a vertex is known only to a part of the scene's size that "
      "a "
      "ray sees. Scenes belong near the origin (docs/guide/accuracy.md, \"Bias\").";
  return {radiance_check(),
          size_check(),
          place_check(20, 1e-3, ""),
          place_check(200, 1e-2, ""),
          place_check(2e3F, 1e-2, few_bits),
          place_check(2e6F, 1e-2, few_bits),
          frame_check("shapes of images", "1x1, 16384x1, 1x16384, an even sky",
                      {{1, 1, 30}, {16384, 1, 30}, {1, 16384, 30}}),
          frame_check("fields of view", "1e-6 to 179 degrees, an even sky",
                      {{16, 16, 1e-6}, {16, 16, 1e-3}, {16, 16, 170}, {16, 16, 179}}),
          samples_check(),
          depth_check()};
}

}  // namespace facet::extremes
