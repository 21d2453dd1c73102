#include "bench/traversal.h"

#include <cmath>

#include "bench/rays.h"
#include "bench/yardstick.h"
#include "core/clock.h"
#include "render/ray_tracer.h"
#include "render/renderer.h"

namespace facet::bench {

namespace {

template <typename Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return seconds_since(start);
}

/// Settings of an image of about so many pixels, and square ones; a path each.
RenderSettings settings_for(const Scene& scene, std::uint32_t pixels) {
  const double aspect = static_cast<double>(scene.camera.width) / scene.camera.height;
  ImageSize size;
  size.height = std::max(1, static_cast<int>(std::sqrt(pixels / aspect)));
  size.width = std::max(1, static_cast<int>(static_cast<double>(pixels) / size.height));
  RenderRequest request;
  request.integrator = "path_mis";
  request.samples = 1;
  request.size = size;
  RenderSettings settings = resolve(scene, request);
  settings.paths_in_flight =
      static_cast<std::uint32_t>(size.width) * static_cast<std::uint32_t>(size.height);
  return settings;
}

/// What the renderer's own camera sends into the scene, in its order.
std::vector<shared::RayRecord> camera_rays(gpu::Device& device, const PackedScene& packed) {
  return Renderer(device, packed).camera_rays();
}

/// One set of rays through both.
class Contest {
 public:
  Contest(RayTracer& tracer, Yardstick* yardstick, const RaySet& set)
      : tracer_(tracer),
        yardstick_(yardstick),
        set_(set),
        distances_(set.rays.size()),
        occluded_(set.rays.size()) {
    tracer_.set_rays(set.rays);
  }

  TraversalRow run(int repeats) {
    TraversalRow row{set_.kind, set_.rays.size(), {}, {}, {}, 1};
    std::vector<double> own;
    std::vector<double> single;
    std::vector<double> packets;
    for (int round = 0; round <= repeats; ++round) {
      const double a = rate(set_.any ? tracer_.trace_any() : tracer_.trace_closest());
      if (round > 0) own.push_back(a);
      if (yardstick_ == nullptr) continue;
      const double c = rate(trace(Yardstick::Calls::packets));
      const double b = rate(trace(Yardstick::Calls::single));
      if (round == 0) continue;
      single.push_back(b);
      packets.push_back(c);
    }
    row.facet = summarise(own);
    if (yardstick_ != nullptr) {
      row.single = summarise(single);
      row.packets = summarise(packets);
      row.equal_hits = count_equal() / static_cast<double>(set_.rays.size());
    }
    return row;
  }

 private:
  [[nodiscard]] double rate(double seconds) const {
    return static_cast<double>(set_.rays.size()) / seconds * 1e-6;
  }

  double trace(Yardstick::Calls calls) {
    return seconds_of([&] {
      if (set_.any) {
        yardstick_->trace_any(set_.rays, calls, occluded_);
      } else {
        yardstick_->trace_closest(set_.rays, calls, distances_);
      }
    });
  }

  [[nodiscard]] double count_equal() const {
    double equal = 0;
    if (set_.any) {
      const std::vector<bool> own = tracer_.occluded();
      for (std::size_t i = 0; i < own.size(); ++i) equal += own[i] == (occluded_[i] != 0) ? 1 : 0;
      return equal;
    }
    const std::vector<shared::HitRecord> own = tracer_.hits();
    for (std::size_t i = 0; i < own.size(); ++i) {
      const bool missed = own[i].triangle == shared::NONE;
      const bool same = missed ? std::isinf(distances_[i])
                               : std::abs(own[i].t - distances_[i]) <= 1e-4F * own[i].t;
      equal += same ? 1 : 0;
    }
    return equal;
  }

  RayTracer& tracer_;
  Yardstick* yardstick_;
  const RaySet& set_;
  std::vector<float> distances_;
  std::vector<char> occluded_;
};

/// Builds both trees afresh in turn. Each was built before.
BuildRow measure_builds(const PackedScene& packed, Yardstick* yardstick, int repeats) {
  std::vector<TriangleCorners> triangles;
  for (const std::uint32_t place : packed.bvh.places) triangles.push_back(packed.triangle(place));
  std::vector<double> own;
  std::vector<double> other;
  for (int round = 0; round < std::min(repeats, 3); ++round) {
    own.push_back(seconds_of([&] { (void)build_bvh(triangles); }));
    if (yardstick != nullptr) other.push_back(yardstick->build());
  }
  BuildRow row{summarise(own), 0, packed.bvh.sah_cost, {}, {}};
  if (yardstick != nullptr) {
    row.yardstick_seconds = summarise(other);
    row.yardstick_bytes = yardstick->bytes();
  }
  return row;
}

}  // namespace

TraversalResult measure_traversal(gpu::Device& device, const std::string& name, Scene scene,
                                  const TraversalOptions& options) {
  const PackedScene packed = pack_scene(scene, settings_for(scene, options.rays));
  const std::vector<shared::RayRecord> camera = camera_rays(device, packed);
  scene.meshes.clear();
  RayTracer tracer(device, packed, static_cast<std::uint32_t>(camera.size()));
  const std::unique_ptr<Yardstick> yardstick = make_yardstick(packed);
  TraversalResult result{name, packed.triangle_count(), {}, {}};
  result.build = measure_builds(packed, yardstick.get(), options.repeats);
  result.build.bytes = tracer.geometry_bytes();
  tracer.set_rays(camera);
  tracer.trace_closest();
  for (const RaySet& set : make_ray_sets(packed, camera, tracer.hits())) {
    if (!set.rays.empty())
      result.rows.push_back(Contest(tracer, yardstick.get(), set).run(options.repeats));
  }
  return result;
}

}  // namespace facet::bench
