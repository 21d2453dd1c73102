// Images at the edge: their shapes, fields of view, samples and crops.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "extremes/scene_parts.h"

namespace facet::extremes {

namespace {

Check image_row(const char* name, const char* range, const char* unit, double limit) {
  return make_check("images", name, range, unit, limit);
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

/// A scene whose pixels all differ.
ScenePtr lit_ball() {
  SceneMaker maker;
  maker.integrator({"path_mis", {{"maxDepth", 4}}});
  maker.sampler({"sobol", {{"sampleCount", 4}}});
  maker.camera(camera({32, 24}, 40, {.origin = {2, 1.5F, -2}, .target = {0, 0, 0}}));
  maker.emitter({"environment"});
  maker.mesh(ball(3, [](const Vector3&) { return 1.0F; }), {"roughsubstrate", {{"alpha", 0.1}}});
  return maker.scene();
}

struct Frame {
  int width;
  int height;
  double fov;
};

Check frame_check(const char* name, const char* range, std::vector<Frame> frames) {
  Check check = image_row(name, range, "relative error of a pixel", 1e-6);
  check.measure = [frames = std::move(frames)](Bench& bench) {
    Finding finding;
    constexpr float radiance = 0.7F;
    for (const Frame& f : frames) {
      const Image image = rendered(bench, sky(radiance, f.width, f.height, f.fov)).image();
      const bool whole = image.width() == f.width && image.height() == f.height;
      finding.add(whole ? largest_error(image, static_cast<double>(radiance))
                        : std::numeric_limits<double>::infinity(),
                  [&] { return fmt::format("{} x {}, {} degrees", f.width, f.height, f.fov); });
    }
    return finding;
  };
  return check;
}

Check samples_check() {
  Check check = image_row("samples of a pixel", "2^24 (2^20 where quick) of an even sky",
                          "relative error", 1e-6);
  check.measure = [](Bench& bench) {
    constexpr float radiance = 0.1F;
    RenderRequest request;
    request.samples = bench.quick() ? 1 << 20 : 1 << 24;
    const Rendered image = rendered(bench, sky(radiance, 1, 1, 30), request);
    Finding finding;
    finding.add(std::abs(image.mean() / static_cast<double>(radiance) - 1),
                [&] { return fmt::format("{} samples", *request.samples); });
    return finding;
  };
  return check;
}

Check crop_check() {
  Check check = image_row("crops", "single pixels, rows and columns at the image's borders",
                          "values that differ from the whole image's in any bit", 0);
  check.measure = [](Bench& bench) {
    Finding finding;
    const ScenePtr scene = lit_ball();
    const Image whole = rendered(bench, scene).image();
    const int w = whole.width();
    const int h = whole.height();
    for (const Crop& c : {Crop{0, 0, 1, 1}, Crop{w - 1, 0, w, 1}, Crop{0, h - 1, 1, h},
                          Crop{w - 1, h - 1, w, h}, Crop{0, 0, w, 1}, Crop{0, h - 1, w, h},
                          Crop{0, 0, 1, h}, Crop{w - 1, 0, w, h}, Crop{0, 0, w, h}}) {
      RenderRequest request;
      request.crop = c;
      const Image crop = rendered(bench, scene, request).image();
      Image part(c.x1 - c.x0, c.y1 - c.y0, {"R", "G", "B"});
      for (int y = c.y0; y < c.y1; ++y) {
        for (int x = c.x0; x < c.x1; ++x) {
          for (int k = 0; k < 3; ++k) part.at(x - c.x0, y - c.y0, k) = whole.at(x, y, k);
        }
      }
      finding.add(count_different(crop, part),
                  [&] { return fmt::format("{},{} to {},{}", c.x0, c.y0, c.x1, c.y1); });
    }
    return finding;
  };
  return check;
}

}  // namespace

std::vector<EdgeScene> image_scenes() {
  return {{"a field of view of 179 degrees", [] { return sky(0.7F, 32, 24, 179); }},
          {"a field of view of 1e-6 degrees", [] { return sky(0.7F, 32, 24, 1e-6); }}};
}

std::vector<Check> image_checks() {
  return {frame_check("shapes of images", "1x1, 16384x1, 1x16384, an even sky",
                      {{1, 1, 30}, {16384, 1, 30}, {1, 16384, 30}}),
          frame_check("fields of view", "1e-6 to 179 degrees, an even sky",
                      {{16, 16, 1e-6}, {16, 16, 1e-3}, {16, 16, 170}, {16, 16, 179}}),
          samples_check(), crop_check()};
}

}  // namespace facet::extremes
