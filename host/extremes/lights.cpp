// Lights at the edge, against closed forms.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "extremes/scene_parts.h"
#include "scene/scene.h"

namespace facet::extremes {

namespace {

constexpr float floor_albedo = 0.5F;

Check light_row(const char* name, const char* range) {
  return make_check("lights", name, range, "standard errors of the mean", 4.5);
}

/// Differential element to a parallel rectangle at distance 1 that begins above it and is a wide
/// and b long: its form factor.
double form_factor(double a, double b) {
  const double x = std::sqrt(1 + a * a);
  const double y = std::sqrt(1 + b * b);
  return (a / x * std::atan(b / x) + b / y * std::atan(a / y)) / (2 * std::numbers::pi);
}

/// What a floor reflects under a square lamp of side 2 and radiance 1 at height 1.
double under_lamp() { return static_cast<double>(floor_albedo) * 4 * form_factor(1, 1); }

/// A floor, one point of which fills the image.
SceneMaker floor_point() {
  SceneMaker maker;
  maker.integrator({"direct_ems"});
  maker.sampler({"independent", {{"sampleCount", 64}}});
  maker.camera(camera({16, 16}, 1e-3, {.origin = {0.6F, 0.5F, 0.3F}, .target = {0, 0, 0}}));
  maker.mesh(grid(1, 0, true), {"diffuse", {{"albedo", gray(floor_albedo)}}});
  return maker;
}

Plugin shining(float radiance) { return {"area", {{"radiance", gray(radiance)}}}; }

/// Adds how many standard errors an image's mean is from the right one; a millionth of it counts
/// as one in images without noise. More noise than 5 % would hide anything.
template <typename Describe>
void add_mean(Finding& finding, const Rendered& image, double right, const Describe& describe) {
  const double error = std::hypot(image.standard_error(), 1e-6 * right);
  const double z = error < 0.05 * right ? std::abs(image.mean() - right) / error
                                        : std::numeric_limits<double>::infinity();
  finding.add(z, [&] {
    return fmt::format("{}: {:.6g} +- {:.2g}, where {:.6g} is right", describe(), image.mean(),
                       error, right);
  });
}

/// The same of renders of a scene with every way to sample its emitters.
void add_estimates(Finding& finding, Bench& bench, const ScenePtr& scene, double right,
                   const std::string& name) {
  constexpr std::array selections{"uniform", "power", "contribution"};
  constexpr std::array samplings{"area", "solid angle"};
  for (const char* integrator : {"direct_ems", "direct_mis"}) {
    for (std::size_t i = 0; i < selections.size(); ++i) {
      for (std::size_t k = 0; k < samplings.size(); ++k) {
        RenderRequest request;
        request.integrator = integrator;
        request.emitter_selection = static_cast<EmitterSelection>(i);
        request.area_sampling = static_cast<AreaSampling>(k);
        add_mean(finding, rendered(bench, scene, request), right, [&] {
          return fmt::format("{}, {}, emitters by {}, points by {}", name, integrator,
                             selections.at(i), samplings.at(k));
        });
      }
    }
  }
}

ScenePtr under(const TriangleMesh& lamp) {
  SceneMaker maker = floor_point();
  maker.mesh(lamp, {"diffuse"}, shining(1));
  return maker.scene();
}

/// A lamp of two triangles, and 2 count^2 tiny ones beside it.
TriangleMesh uneven_lamp(int count) {
  TriangleMesh lamp = moved(grid(count, 1, false), {1e-4F, 1, 1e-4F}, {1.5F, 0, 0});
  append(lamp, grid(1, 1, false));
  return lamp;
}

Check fine_lamp_check() {
  Check check =
      light_row("lamps of a million triangles",
                "(20,000 where quick) of one size; a lamp of two beside as many tiny ones");
  check.measure = [](Bench& bench) {
    const int count = bench.quick() ? 100 : 708;
    Finding finding;
    add_estimates(finding, bench, under(grid(count, 1, false)), under_lamp(), "of one size");
    add_estimates(finding, bench, under(uneven_lamp(count)), under_lamp(), "two beside tiny ones");
    return finding;
  };
  return check;
}

/// A lamp without power, and one with power where `both`.
ScenePtr dark_lamp(bool both) {
  SceneMaker maker = floor_point();
  maker.mesh(moved(grid(1, 1, false), {1, 1, 1}, {3, 0, 0}), {"diffuse"}, shining(0));
  if (both) maker.mesh(grid(1, 1, false), {"diffuse"}, shining(1));
  return maker.scene();
}

Check dark_lamp_check() {
  Check check = light_row("lamps without power", "alone, and beside one with power");
  check.measure = [](Bench& bench) {
    Finding finding;
    const Rendered nothing = rendered(bench, dark_lamp(false));
    finding.add(
        nothing.mean() == 0 && nothing.nonzero() == 0 ? 0 : std::numeric_limits<double>::infinity(),
        [] { return "alone"; });
    add_estimates(finding, bench, dark_lamp(true), under_lamp(), "beside one");
    return finding;
  };
  return check;
}

/// Of one texel, bilinear around (i, j), to a floor below: Simpson's rule over its rows.
double sky_irradiance(int width, int height, int row) {
  const auto at = [&](double s) {
    const double theta = std::numbers::pi * (1 - (row + s) / height);
    return (1 - std::abs(s)) * std::sin(theta) * std::cos(theta);
  };
  double sum = 0;
  constexpr int steps = 64;
  for (int i = 0; i < steps; ++i) {
    const double a = -1 + 2.0 * i / steps;
    const double h = 2.0 / steps;
    sum += h / 6 * (at(a) + 4 * at(a + h / 2) + at(a + h));
  }
  return 2 * std::numbers::pi / width * std::numbers::pi / height * sum;
}

/// Of the bright texel of a map of that height, above the horizon.
int bright_row(int height) { return 5 * height / 8; }

/// A black sky of 2 height x height texels but for one of 1e6.
ScenePtr bright_texel(int height) {
  SceneMaker maker = floor_point();
  maker.emitter({"environment"});
  Scene scene = *maker.scene();
  EnvironmentEmitter sky{.width = 2 * height, .height = height, .texels = {}};
  const auto rows = static_cast<std::size_t>(height);
  sky.texels.assign(2 * rows * rows, Color(0));
  sky.texels[static_cast<std::size_t>(bright_row(height)) * 2 * rows + rows / 2] = Color(1e6F);
  for (Emitter& e : scene.emitters) e = sky;
  return std::make_shared<const Scene>(std::move(scene));
}

Check bright_texel_check() {
  Check check = light_row("one texel of 1e6 in a black sky", "maps of 16x8 to 1024x512 texels");
  check.measure = [](Bench& bench) {
    Finding finding;
    for (const int height : {8, 64, 512}) {
      const double right = static_cast<double>(floor_albedo) / std::numbers::pi * 1e6 *
                           sky_irradiance(2 * height, height, bright_row(height));
      add_estimates(finding, bench, bright_texel(height), right,
                    fmt::format("{}x{}", 2 * height, height));
    }
    return finding;
  };
  return check;
}

/// A black lamp of radiance 1 straight below a pane of that index, or within the glass.
ScenePtr lamp_and_glass(double index, bool within) {
  SceneMaker maker;
  maker.integrator({"path_mis", {{"maxDepth", 10000}}});
  maker.sampler({"independent", {{"sampleCount", 256}}});
  maker.camera(camera({16, 16}, 1e-3, {.origin = {0, 9, 0}, .target = {0, 0, 0}, .up = {0, 0, 1}}));
  maker.mesh(moved(box({9, within ? 1.0F : 0.1F, 9}), {1, 1, 1}, {0, within ? 0.0F : 2.0F, 0}),
             {"dielectric", {{"intIOR", index}, {"extIOR", 1.0}}});
  maker.mesh(moved(grid(1, 0, true), {5, 1, 5}, {}), {"diffuse", {{"albedo", gray(0)}}},
             shining(1));
  return maker.scene();
}

/// Below a pane, light goes to and fro between its sides; within, radiance is index^2 times that
/// outside.
Check glass_check() {
  Check check = light_row("lamps below and in glass", "indices 1, 1.000001, 1.5, 10 and 100");
  check.measure = [](Bench& bench) {
    Finding finding;
    for (const double n : {1.0, 1.000001, 1.5, 10.0, 100.0}) {
      for (const bool within : {false, true}) {
        const double r = std::pow((n - 1) / (n + 1), 2);
        const double right = within ? (1 - r) / (n * n) : (1 - r) / (1 + r);
        add_mean(finding, rendered(bench, lamp_and_glass(n, within)), right,
                 [&] { return fmt::format("index {}, {}", n, within ? "within" : "below"); });
      }
    }
    return finding;
  };
  return check;
}

}  // namespace

std::vector<EdgeScene> light_scenes() {
  return {
      {"a lamp of 20,000 triangles", [] { return under(grid(100, 1, false)); }},
      {"a lamp of two triangles beside 20,000 tiny ones", [] { return under(uneven_lamp(100)); }},
      {"a lamp without power", [] { return dark_lamp(true); }},
      {"one texel of 1e6 in a black sky", [] { return bright_texel(64); }},
      {"a lamp in glass of index 100", [] { return lamp_and_glass(100, true); }}};
}

std::vector<Check> light_checks() {
  return {fine_lamp_check(), dark_lamp_check(), bright_texel_check(), glass_check()};
}

}  // namespace facet::extremes
