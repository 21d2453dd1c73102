// Whole renders at the edges: sizes, places and radiances of scenes, shapes of images, fields of
// view, many samples, long paths.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "extremes/scene_parts.h"

namespace facet::extremes {

namespace {

/// What is varied of a scene of some two units.
struct Variation {
  float scale = 1;
  Vector3 offset{};
  float radiance = 10;
};

TriangleMesh placed(TriangleMesh mesh, const Variation& v) {
  return moved(std::move(mesh), {v.scale, v.scale, v.scale}, v.offset);
}

Vector3 placed(const Vector3& p, const Variation& v) {
  return placed(TriangleMesh{.positions = {p}, .triangles = {}}, v).positions[0];
}

constexpr const char* few_bits =
    "A float has 24 bits: so far away, a vertex is known only to a part of the scene's size that a "
    "ray sees. Scenes belong near the origin (docs/guide/accuracy.md, \"Bias\").";

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
  maker.camera(camera({32, 24}, 40,
                      {.origin = placed({1, 1.25F, -2}, v), .target = placed({0, 0.125F, 0}, v)}));
  maker.mesh(placed(quad({-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}), v),
             {"diffuse", {{"albedo", gray(0.5F)}}});
  maker.mesh(placed(body, v), {"roughconductor", {{"alpha", 0.2}}});
  maker.mesh(
      placed(quad({-0.5F, 2, -0.5F}, {0.5F, 2, -0.5F}, {0.5F, 2, 0.5F}, {-0.5F, 2, 0.5F}), v),
      {"diffuse"}, {"area", {{"radiance", gray(v.radiance)}}});
  return maker.scene();
}

/// The pyramid so far away, in units of its size.
ScenePtr moved_pyramid(float distance) {
  const float x = 2 * distance;
  return pyramid({.offset = {x, 0.7F * x, -0.4F * x}});
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

Check scene_row(const char* name, const char* range, const char* unit, double limit) {
  return make_check("scenes", name, range, unit, limit);
}

/// The inside of a cube all of whose walls emit 1 and reflect `albedo`: what is seen is the sum of
/// that series up to the largest depth.
ScenePtr glowing_room(float albedo, int depth) {
  SceneMaker maker;
  maker.integrator({"path_mats", {{"maxDepth", depth}}});
  maker.sampler({"independent", {{"sampleCount", 64}}});
  maker.camera(camera({16, 16}, 90, {.origin = {0, 0, -0.5F}, .target = {0, 0.1F, 1}}));
  maker.mesh(box({1, 1, 1}, true), {"diffuse", {{"albedo", gray(albedo)}}},
             {"area", {{"radiance", gray(1)}}});
  return maker.scene();
}

Check radiance_check() {
  Check check = scene_row("radiance", "lamps from 1e-20 to 1e20, against one of 1 times that",
                          "relative error of a pixel", 1e-5);
  check.measure = [](Bench& bench) {
    Finding finding;
    const Image one = rendered(bench, pyramid({.radiance = 1})).image();
    for (int e = -20; e <= 20; e += 5) {
      const auto radiance = static_cast<float>(std::pow(10.0, e));
      const Image image = rendered(bench, pyramid({.radiance = radiance})).image();
      double worst = 0;
      for_each_value(image, one, [&](double a, double b) {
        const double right = b * static_cast<double>(radiance);
        const double error = std::abs(a - right) / std::max(right, 1e-30);
        // NaN, which compares with nothing, stays.
        if (!(error <= worst) && !std::isnan(worst)) worst = error;
      });
      finding.add(worst, [&] { return fmt::format("radiance 1e{}", e); });
    }
    return finding;
  };
  return check;
}

/// The variances that an image's file holds, against those of radiance 1 times the radiance's
/// square.
Check variance_check(const char* name, std::vector<int> exponents, const char* argued) {
  Check check =
      scene_row(name, "of the image of a lamp, against one of radiance 1 times its square",
                "relative error", 1e-5);
  check.argued = argued;
  check.measure = [exponents = std::move(exponents)](Bench& bench) {
    Finding finding;
    RenderRequest request;
    request.variance = true;
    const Image one = develop(rendered(bench, pyramid({.radiance = 1}), request).film, true);
    const int channel = one.find_channel("variance.R");
    for (const int e : exponents) {
      const float radiance = std::ldexp(1.0F, e);
      const Image image =
          develop(rendered(bench, pyramid({.radiance = radiance}), request).film, true);
      double worst = 0;
      for (int y = 0; y < one.height(); ++y) {
        for (int x = 0; x < one.width(); ++x) {
          const double right = static_cast<double>(one.at(x, y, channel)) *
                               static_cast<double>(radiance) * static_cast<double>(radiance);
          const double error = std::abs(static_cast<double>(image.at(x, y, channel)) - right);
          if (right > static_cast<double>(std::numeric_limits<float>::min()))
            worst = std::max(worst, error / right);
        }
      }
      finding.add(worst, [&] { return fmt::format("radiance 2^{}", e); });
    }
    return finding;
  };
  return check;
}

/// Powers of two change no bit of any mantissa: where the image changes, a constant of the code has
/// a size of its own, or floats end.
Check size_check() {
  Check check =
      scene_row("size of the scene",
                "times 2^-55 to 2^60, against the scene itself; densities of points on the lamp "
                "from 1e-36 to 1e33, points by area and by solid angle",
                "values that differ in any bit", 0);
  check.measure = [](Bench& bench) {
    Finding finding;
    for (const AreaSampling sampling : {AreaSampling::area, AreaSampling::solid_angle}) {
      RenderRequest request;
      request.area_sampling = sampling;
      const Image one = rendered(bench, pyramid({}), request).image();
      for (int e = -55; e <= 60; e += 5) {
        const Image image =
            rendered(bench, pyramid({.scale = std::ldexp(1.0F, e)}), request).image();
        finding.add(count_different(image, one), [&] {
          return fmt::format("2^{}, points by {}", e,
                             sampling == AreaSampling::area ? "area" : "solid angle");
        });
      }
    }
    return finding;
  };
  return check;
}

Check place_check(float distance, double limit, const char* argued) {
  Check check = scene_row("", "the scene moved along (1, 0.7, -0.4), against itself at the origin",
                          "relative RMSE, at equal random numbers", limit);
  check.name = fmt::format("{:g} sizes from the origin", distance);
  check.argued = argued;
  check.measure = [distance](Bench& bench) {
    Finding finding;
    finding.add(relative_rmse(rendered(bench, moved_pyramid(distance)).image(),
                              rendered(bench, pyramid({})).image()),
                [&] { return fmt::format("at {:g} times (2, 1.4, -0.8)", distance); });
    return finding;
  };
  return check;
}

Check depth_check() {
  Check check = scene_row("depth of paths", "1000 in a closed room of albedo 0.99 whose walls emit",
                          "standard errors of the mean", 4.5);
  check.measure = [](Bench& bench) {
    constexpr float albedo = 0.99F;
    constexpr int depth = 1000;
    const Rendered image = rendered(bench, glowing_room(albedo, depth));
    const double right =
        (1 - std::pow(static_cast<double>(albedo), depth)) / (1 - static_cast<double>(albedo));
    Finding finding;
    finding.add(std::abs(image.mean() - right) / image.standard_error(),
                [&] { return fmt::format("{:.6g}, where {:.6g} is right", image.mean(), right); });
    return finding;
  };
  return check;
}

/// A diffuse floor under an even sky is as bright as its albedo everywhere.
Check mesh_check() {
  Check check = scene_row("meshes",
                          "a floor of 10 million triangles (100,000 where quick), of two with "
                          "coordinates of 1e-15 to 1e18, without normals, with zero ones, without "
                          "texture coordinates",
                          "relative error of a pixel", 1e-6);
  check.measure = [](Bench& bench) {
    Finding finding;
    constexpr float albedo = 0.7F;
    const auto add = [&](const TriangleMesh& floor, float size, const std::string& name) {
      SceneMaker maker;
      maker.integrator({"direct_mats"});
      maker.sampler({"independent", {{"sampleCount", 4}}});
      maker.camera(
          camera({64, 64}, 20, {.origin = {0.1F * size, size, 0.2F * size}, .target = {0, 0, 0}}));
      maker.emitter({"environment"});
      maker.mesh(floor, {"diffuse", {{"albedo", gray(albedo)}}});
      const Image image = rendered(bench, maker.scene()).image();
      finding.add(largest_error(image, static_cast<double>(albedo)), [&] { return name; });
    };
    const int count = bench.quick() ? 224 : 2237;
    add(grid(count, 0, true), 1, fmt::format("{} triangles", 2 * count * count));
    for (const float size : {1e-15F, 1e15F, 1e18F})
      add(moved(grid(1, 0, true), {size, size, size}, {}), size, fmt::format("size {:g}", size));
    TriangleMesh dressed = grid(4, 0, true);
    dressed.normals.assign(dressed.positions.size(), {0, 0, 0});
    add(dressed, 1, "zero normals");
    dressed.normals.assign(dressed.positions.size(), {0, 1, 0});
    add(dressed, 1, "with normals");
    dressed.texcoords.assign(dressed.positions.size(), {0.5F, 0.5F});
    add(dressed, 1, "with texture coordinates");
    return finding;
  };
  return check;
}

}  // namespace

std::vector<EdgeScene> whole_scenes() {
  return {{"radiance 1e-20", [] { return pyramid({.radiance = 1e-20F}); }},
          {"radiance 1e15", [] { return pyramid({.radiance = 1e15F}); }},
          {"radiance 1e20", [] { return pyramid({.radiance = 1e20F}); }},
          {"a scene times 2^-55", [] { return pyramid({.scale = 0x1p-55F}); }},
          {"a scene times 2^60", [] { return pyramid({.scale = 0x1p60F}); }},
          {"a scene 100 sizes from the origin", [] { return moved_pyramid(100); }},
          {"a scene 1000 sizes from the origin", [] { return moved_pyramid(1000); }, few_bits},
          {"a scene 1e6 sizes from the origin", [] { return moved_pyramid(1e6F); }, few_bits},
          {"paths of 1000 in a room of albedo 0.99", [] { return glowing_room(0.99F, 1000); }}};
}

std::vector<Check> scene_checks() {
  return {radiance_check(),
          variance_check("variances, radiance 2^-33 to 2^66", {-33, -20, -10, 10, 20, 40, 66}, ""),
          variance_check("variances, radiance 2^80", {80},
                         "Beyond 3.4e38, what an image's file holds of a variance is infinite. "
                         "Error estimates and stop rules are formed in double."),
          size_check(),
          place_check(10, 1e-3, ""),
          place_check(100, 1e-2, ""),
          place_check(1e3F, 1e-2, few_bits),
          place_check(1e6F, 1e-2, few_bits),
          depth_check(),
          mesh_check()};
}

}  // namespace facet::extremes
